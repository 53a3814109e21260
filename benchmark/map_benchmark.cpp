// SPDX-License-Identifier: Apache-2.0
//
// map_benchmark FILE...
// Measures, for each map file, how long loading takes beside protobuf's own parsing of the same bytes, how much memory
// the loaded map needs and how long a nearest-lane query takes. Prints one JSON array.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>

#include "external_command/map/map_reader.h"
#include "external_command/proto/base_map.pb.h"

namespace external_command {
namespace {

constexpr std::size_t kRepetitions = 21;  ///< fewer, but three at least, of what takes long
constexpr double kPatience = 10.0;        ///< [s]
constexpr int kQueries = 100000;

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// Median duration [s] of one call.
template <class Function>
double medianTime(const Function& function) {
  std::vector<double> times;
  const double begin = now();
  while (times.size() < 3 || (times.size() < kRepetitions && now() - begin < kPatience)) {
    const double start = now();
    function();
    times.push_back(now() - start);
  }
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

/// Resident memory of this process [bytes].
double residentBytes() {
  std::ifstream in("/proc/self/statm");
  double total = 0.0, resident = 0.0;
  in >> total >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Duration [s] of protobuf's parsing into a message of this package's description; negative for a text file.
double parseTime(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  const auto parse = [&bytes] { return proto::Map().ParsePartialFromString(bytes); };
  return parse() ? medianTime(parse) : -1.0;
}

/// Duration [s] of one query at a random point of the map's box.
double queryTime(const HdMap& map) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::vector<Point2d> points;
  const Point2d size = map.box().max - map.box().min;
  for (int i = 0; i < kQueries; ++i) {
    points.push_back(map.box().min + Point2d(share(random) * size.x(), share(random) * size.y()));
  }
  std::size_t found = 0;
  const double start = now();
  for (const Point2d& point : points) found += map.nearestLane(point, {}).has_value();
  return found == 0 ? -1.0 : (now() - start) / kQueries;
}

std::string report(const std::string& file) {
  const double before = residentBytes();
  auto map = readMap(file, {});
  const double growth = residentBytes() - before;
  const double query = queryTime(*map);
  const std::size_t lanes = map->lanes().size();
  map.reset();
  const double load = medianTime([&file] { return readMap(file, {}); });
  const double parse = parseTime(file);
  std::ostringstream out;
  out << "  {\"file\": \"" << file << "\", \"lanes\": " << lanes << ", \"load_ms\": " << load * 1e3;
  if (parse > 0.0) out << ", \"protobuf_parse_ms\": " << parse * 1e3 << ", \"ratio\": " << load / parse;
  out << ", \"file_mb\": " << static_cast<double>(std::filesystem::file_size(file)) / 1e6;
  out << ", \"memory_growth_mb\": " << growth / 1e6 << ", \"nearest_lane_us\": " << query * 1e6 << "}";
  return out.str();
}

/// Each file is measured in a process of its own, so that none finds the memory of the one before.
bool reportInChild(const std::string& file, const char* end) {
  std::cout.flush();
  const pid_t child = ::fork();
  if (child == 0) {
    int status = 0;
    try {
      std::cout << report(file) << end;
    } catch (const std::exception& error) {
      std::cerr << error.what() << "\n";
      status = 1;
    }
    std::cout.flush();
    ::_exit(status);
  }
  int status = 1;
  return child > 0 && ::waitpid(child, &status, 0) == child && status == 0;
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: map_benchmark FILE...\n";
    return 1;
  }
  bool ok = true;
  std::cout << "[\n";
  for (int i = 1; i < argc; ++i) ok &= external_command::reportInChild(argv[i], i + 1 < argc ? ",\n" : "\n");
  std::cout << "]\n";
  return ok ? 0 : 1;
}
