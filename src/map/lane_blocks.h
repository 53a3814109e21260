// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

#include "map_faults.h"

namespace external_command {

/// Calls `job(begin, end, faults)` for blocks of the positions [0, count), several at once where they are many: what is
/// done to one lane must not be seen by another's. The faults go to `faults`, in the order of the blocks.
void inBlocks(std::size_t count, MapFaults* faults,
              const std::function<void(std::size_t begin, std::size_t end, MapFaults* faults)>& job);

}  // namespace external_command
