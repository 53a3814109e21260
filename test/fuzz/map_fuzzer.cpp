// SPDX-License-Identifier: Apache-2.0
// Loads damaged maps, and drives about in those that are still maps, until a time is up: map_fuzzer MINUTES SEED
// FILE... Each line is a figure; the exit code is 1 where a map took too long or too much memory, or anything but a
// MapError or the refusal of a route came of it; where the process ends, the file named first is the map that ended it.
// Built with clang's -fsanitize=fuzzer and -DEC_LIBFUZZER, the same is libFuzzer's target.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <iterator>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/map/map_reader.h"
#include "random_drives.h"

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kMostTime = 5.0;      // for one map [s]
constexpr double kMostMemory = 500.0;  // [MB]

void write(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << bytes;
}

/// What comes of a map: nullptr where it is none. Anything but a MapError goes on.
std::shared_ptr<const external_command::HdMap> load(const std::string& path) {
  try {
    return external_command::readMap(path, {});
  } catch (const external_command::MapError&) {
    return nullptr;
  }
}

struct Outcome {
  bool is_map = false;
  std::size_t paths = 0;
};

/// A map's drives depend on its bytes only.
Outcome tryMap(const std::string& path, const std::string& bytes) {
  write(path, bytes);
  const auto map = load(path);
  if (!map) return {};
  std::mt19937 random(static_cast<unsigned>(std::hash<std::string>()(bytes)));
  return {true, external_command::driveAbout(map, &random)};
}

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// [MB], the most so far
double memoryTaken() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) * 1024.0 / 1e6;
}

class Damage {
 public:
  explicit Damage(unsigned seed) : random_(seed) {}

  /// Every other time it is only numbers and ids that change, so that many are maps still.
  std::string of(std::string bytes) {
    const bool is_gentle = below(2) == 0;
    for (std::size_t changes = 1 + below(6); changes > 0 && !bytes.empty(); --changes) {
      is_gentle ? changeDigit(&bytes) : change(&bytes);
    }
    return bytes;
  }

  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

 private:
  void change(std::string* bytes) {
    const std::size_t at = below(bytes->size());
    switch (below(6)) {
      case 0:
        (*bytes)[at] = static_cast<char>(below(256));
        break;
      case 1:
        (*bytes)[at] = static_cast<char>((*bytes)[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes->resize(at);
        break;
      case 3:
        bytes->erase(at, 1 + below(50));
        break;
      case 4:
        bytes->insert(at, bytes->substr(below(bytes->size()), 1 + below(500)));
        break;
      default:
        setNumber(bytes, at);
    }
  }

  /// The next one behind a place.
  void changeDigit(std::string* bytes) {
    static constexpr char kDigits[] = "0123456789.-e";
    const std::size_t at = bytes->find_first_of("0123456789", below(bytes->size()));
    if (at == std::string::npos) return;
    const char digit = kDigits[below(std::size(kDigits) - 1)];
    below(4) == 0 ? bytes->insert(at, 1, digit) : bytes->replace(at, 1, 1, digit);
  }

  /// A double or a count in the middle of it.
  void setNumber(std::string* bytes, std::size_t at) {
    static constexpr double kNumbers[] = {0.0, -1.0, 1e7, 1e9, 1e300, -1e308, 1e-300};
    const double number = kNumbers[below(std::size(kNumbers))];
    const char* const raw = reinterpret_cast<const char*>(&number);
    if (at + sizeof(number) <= bytes->size()) bytes->replace(at, sizeof(number), raw, sizeof(number));
  }

  std::mt19937 random_;
};

}  // namespace

#ifdef EC_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size) {
  const std::string path = "/tmp/external_command_map_fuzzer." + std::to_string(getpid());
  tryMap(path, std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}

#else

int main(int argc, char** argv) {
  if (argc < 4) {
    std::cerr << "usage: map_fuzzer MINUTES SEED FILE...\n";
    return 2;
  }
  const Seconds time(60.0 * std::atof(argv[1]));
  Damage damage(static_cast<unsigned>(std::atoi(argv[2])));
  std::vector<std::string> maps;
  for (int i = 3; i < argc; ++i) maps.push_back(bytesOf(argv[i]));
  char path[] = "/tmp/external_command_map_fuzzer.XXXXXX";
  if (mkstemp(path) < 0) return 2;
  std::printf("each damaged map is written to %s\n", path);
  std::fflush(stdout);
  const Clock::time_point begin = Clock::now();
  std::size_t tried = 0, taken = 0, paths = 0, faults = 0;
  double slowest = 0.0;
  while (Clock::now() - begin < time) {
    const std::string bytes = damage.of(maps[damage.below(maps.size())]);
    const Clock::time_point start = Clock::now();
    const double memory = memoryTaken();
    std::string fault;
    try {
      const Outcome outcome = tryMap(path, bytes);
      taken += outcome.is_map;
      paths += outcome.paths;
    } catch (const std::exception& error) {
      fault = error.what();
    }
    ++tried;
    const double took = Seconds(Clock::now() - start).count();
    slowest = std::max(slowest, took);
    if (took > kMostTime) fault = "it took " + std::to_string(took) + " s";
    if (memory < kMostMemory && memoryTaken() > kMostMemory) fault = "it took more than 500 MB";
    if (fault.empty()) continue;
    const std::string kept = std::string(path) + "-" + std::to_string(++faults);
    write(kept, bytes);
    std::printf("FAULT: %s: %s\n", kept.c_str(), fault.c_str());
  }
  std::remove(path);
  std::printf(
      "damaged maps tried %zu, taken for a map %zu, paths in them %zu, slowest %.3f s, most memory %.0f MB, "
      "faults %zu\n",
      tried, taken, paths, slowest, memoryTaken(), faults);
  return faults > 0 ? 1 : 0;
}

#endif
