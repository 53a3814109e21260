// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "external_command/CommandStatus.h"

namespace external_command {

/// Removes each of `pending` for which `end(item)` gives a status (std::optional), and returns these statuses.
template <class Pending, class End>
std::vector<CommandStatus> endWhere(std::vector<Pending>* pending, const End& end) {
  std::vector<CommandStatus> ended;
  for (auto item = pending->begin(); item != pending->end();) {
    const std::optional<CommandStatus> status = end(*item);
    if (status) ended.push_back(*status);
    item = status ? pending->erase(item) : item + 1;
  }
  return ended;
}

}  // namespace external_command
