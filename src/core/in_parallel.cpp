// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/in_parallel.h"

#include <algorithm>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace external_command {

std::size_t parallelParts(std::size_t most) {
  return std::max<std::size_t>(1, std::min<std::size_t>(most, std::thread::hardware_concurrency()));
}

void inParallel(std::size_t parts, const std::function<void(std::size_t)>& job) {
  std::vector<std::exception_ptr> thrown(parts);
  const auto run = [&](std::size_t part) {
    try {
      job(part);
    } catch (...) {
      thrown[part] = std::current_exception();
    }
  };
  std::vector<std::thread> threads;
  threads.reserve(parts);
  std::size_t started = 1;
  try {
    for (; started < parts; ++started) threads.emplace_back(run, started);
  } catch (const std::system_error&) {  // there are too many threads
  }
  for (std::size_t part = started; part < parts; ++part) run(part);
  if (parts > 0) run(0);
  for (std::thread& thread : threads) thread.join();
  for (const std::exception_ptr& error : thrown) {
    if (error) std::rethrow_exception(error);
  }
}

}  // namespace external_command
