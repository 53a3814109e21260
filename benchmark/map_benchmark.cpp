// SPDX-License-Identifier: Apache-2.0
//
// map_benchmark FILE...
// Measures, for each map file, how long loading takes beside protobuf's own parsing of the same bytes, how much memory
// the loaded map needs and how long a nearest-lane query takes; and of a large map how long it takes until routes can
// be searched, at a first start and from the cache at the next one. Prints one JSON array.
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <random>
#include <sstream>
#include <system_error>

#include "external_command/map/map_reader.h"
#include "external_command/proto/base_map.pb.h"
#include "external_command/routing/router_cache.h"

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

/// Resident memory of this process [bytes], as /proc/self/status has it: now, VmRSS, or at most, VmHWM.
double residentBytes(const std::string& key = "VmRSS") {
  std::ifstream in("/proc/self/status");
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(key + ":", 0) == 0) return std::stod(line.substr(key.size() + 1)) * 1024.0;
  }
  return 0.0;
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

/// A folder that exists as long as this object does.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_((std::filesystem::temp_directory_path() / "map_benchmark_XXXXXX").string()) {
    if (::mkdtemp(&path_[0]) == nullptr) throw std::system_error(errno, std::generic_category(), path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

struct Start {
  double time;               ///< [s]
  double resident, highest;  ///< memory afterwards, and at most meanwhile [bytes]
};

/// One start in a process of its own, which keeps the router where `cache` is given.
Start startOf(const std::function<std::shared_ptr<const Router>()>& start, const RouterCache* cache) {
  int ends[2];
  if (::pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  const pid_t child = ::fork();
  if (child == 0) {
    const double begin = now();
    const auto router = start();
    Start measured{now() - begin, residentBytes(), residentBytes("VmHWM")};
    if (!router) measured.time = -1.0;
    if (router && cache != nullptr) cache->write(*router, CancelToken());
    ::_exit(::write(ends[1], &measured, sizeof measured) == sizeof measured ? 0 : 1);
  }
  ::close(ends[1]);
  Start measured{-1.0, 0.0, 0.0};
  if (::read(ends[0], &measured, sizeof measured) != sizeof measured) measured.time = -1.0;
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return measured;
}

/// The one in the middle by time, of three.
Start medianStart(const std::function<std::shared_ptr<const Router>()>& start, const RouterCache* cache) {
  std::vector<Start> starts;
  for (int i = 0; i < 3; ++i) starts.push_back(startOf(start, cache));
  std::sort(starts.begin(), starts.end(), [](const Start& a, const Start& b) { return a.time < b.time; });
  return starts[1];
}

std::string reportOfStarts(const std::string& file) {
  const TemporaryFolder folder;
  const RouterSource source{file, {}, {}, {}};
  const RouterCache cache(folder.path(), source);
  if (!cache.isWorthwhile()) return "";
  const Start first = medianStart(
      [&] { return std::make_shared<const Router>(readMap(file, source.origin, source.map), source.router); }, &cache);
  const Start second = medianStart([&] { return cache.read().router; }, nullptr);
  std::ostringstream out;
  out << ", \"first_start_ms\": " << first.time * 1e3 << ", \"second_start_ms\": " << second.time * 1e3
      << ", \"first_start_mb\": " << first.resident / 1e6 << ", \"second_start_mb\": " << second.resident / 1e6
      << ", \"first_start_peak_mb\": " << first.highest / 1e6 << ", \"second_start_peak_mb\": " << second.highest / 1e6
      << ", \"cache_mb\": " << static_cast<double>(std::filesystem::file_size(cache.path())) / 1e6;
  return out.str();
}

std::string report(const std::string& file) {
  const std::string starts = reportOfStarts(file);
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
  out << ", \"memory_growth_mb\": " << growth / 1e6 << ", \"nearest_lane_us\": " << query * 1e6 << starts << "}";
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
