// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

namespace external_command {

/// How many parts a piece of work is best cut into: one for each processor, no more than `most`, and at least one.
std::size_t parallelParts(std::size_t most);

/// Calls `job(part)` for each of the `parts`, each on a thread of its own, the first on the caller's, and waits for
/// all. Where a thread cannot be made the caller does its part, too. What jobs throw is thrown again: of several that
/// of the lowest part.
void inParallel(std::size_t parts, const std::function<void(std::size_t)>& job);

}  // namespace external_command
