// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "external_command/core/text.h"
#include "external_command/ros/command_registry.h"
#include "external_command/ros/status.h"

namespace external_command {

/// Removes each of `pending` for which `end(item)` gives a status (std::optional), and returns these statuses; the
/// items hold their `command`.
template <class Pending, class End>
std::vector<StatusChange> endWhere(std::vector<Pending>* pending, const End& end) {
  std::vector<StatusChange> ended;
  for (auto item = pending->begin(); item != pending->end();) {
    const std::optional<CommandStatus> status = end(*item);
    if (status) ended.push_back({item->command.serial, *status});
    item = status ? pending->erase(item) : item + 1;
  }
  return ended;
}

/// The status of a command whose end nobody waits for any more.
inline CommandStatus unloaded(std::int64_t command_id) {
  return makeStatus(command_id, CommandStatus::UNKNOWN, ErrorCode::kOk,
                    "it was sent, but its processor was unloaded before anything showed its end");
}

/// Their processor is unloaded.
template <class Pending>
std::vector<StatusChange> endAll(std::vector<Pending>* pending) {
  return endWhere(pending,
                  [](const Pending& item) -> std::optional<CommandStatus> { return unloaded(item.command.id); });
}

/// Drops those whose command has ended another way: `is_running(serial)` is false.
template <class Pending, class IsRunning>
void keepWhere(const IsRunning& is_running, std::vector<Pending>* pending) {
  const auto has_ended = [&](const Pending& item) { return !is_running(item.command.serial); };
  pending->erase(std::remove_if(pending->begin(), pending->end(), has_ended), pending->end());
}

/// What is waited for stays bounded, whatever is flooded in.
constexpr std::size_t kMostPending = 1000;

/// Adds `item`; of too many the oldest ends, whose status is given.
template <class Pending>
std::vector<StatusChange> addPending(std::vector<Pending>* pending, Pending item) {
  std::vector<StatusChange> ended;
  if (pending->size() >= kMostPending) {
    const AdmittedCommand& oldest = pending->front().command;
    ended.push_back({oldest.serial, makeStatus(oldest.id, CommandStatus::ERROR, ErrorCode::kSuperseded,
                                               text("its end is waited for no longer: ", kMostPending,
                                                    " newer commands of its service are pending"))});
    pending->erase(pending->begin());
  }
  pending->push_back(std::move(item));
  return ended;
}

}  // namespace external_command
