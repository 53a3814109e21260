// SPDX-License-Identifier: Apache-2.0
// Loads damaged maps until a time is up: map_fuzzer MINUTES SEED FILE...
// Each line is a figure; the exit code is 1 where a map took too long or too much memory, or anything but a MapError
// came of it. Built with clang's -fsanitize=fuzzer and -DEC_LIBFUZZER, the same is libFuzzer's target.
#include <sys/resource.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/map/map_reader.h"
#include "external_command/routing/router.h"

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kMostTime = 5.0;      // for one map [s]
constexpr double kMostMemory = 500.0;  // [MB]

/// What comes of a map: true where it is one. Anything but a MapError goes on.
bool load(const std::string& path) {
  try {
    const auto map = external_command::readMap(path, {});
    external_command::Router router(map, {});
    return true;
  } catch (const external_command::MapError&) {
    return false;
  }
}

void write(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << bytes;
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

  std::string of(std::string bytes) {
    for (std::size_t changes = 1 + below(6); changes > 0 && !bytes.empty(); --changes) change(&bytes);
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
  write(path, std::string(reinterpret_cast<const char*>(data), size));
  load(path);
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
  const Clock::time_point begin = Clock::now();
  std::size_t tried = 0, taken = 0, faults = 0;
  double slowest = 0.0;
  while (Clock::now() - begin < time) {
    const std::string bytes = damage.of(maps[damage.below(maps.size())]);
    write(path, bytes);
    const Clock::time_point start = Clock::now();
    const double memory = memoryTaken();
    std::string fault;
    try {
      taken += load(path);
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
  std::printf("damaged maps tried %zu, taken for a map %zu, slowest %.3f s, most memory %.0f MB, faults %zu\n", tried,
              taken, slowest, memoryTaken(), faults);
  return faults > 0 ? 1 : 0;
}

#endif
