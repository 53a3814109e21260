// SPDX-License-Identifier: Apache-2.0
#include "lane_blocks.h"

#include <utility>
#include <vector>

#include "external_command/core/in_parallel.h"

namespace external_command {

namespace {

constexpr std::size_t kLeastBlock = 10000;  // of fewer lanes, threads are not made

}  // namespace

void inBlocks(std::size_t count, MapFaults* faults,
              const std::function<void(std::size_t begin, std::size_t end, MapFaults* faults)>& job) {
  const std::size_t blocks = parallelParts(count / kLeastBlock);
  std::vector<MapFaults> found(blocks, MapFaults(faults->keepsAll()));
  inParallel(blocks,
             [&](std::size_t block) { job(block * count / blocks, (block + 1) * count / blocks, &found[block]); });
  for (MapFaults& part : found) faults->append(std::move(part));
}

}  // namespace external_command
