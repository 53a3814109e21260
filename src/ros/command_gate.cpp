// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_gate.h"

#include "external_command/core/text.h"

namespace external_command {

CommandGate::Arrival CommandGate::arrive() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  Arrival arrival;
  arrival.stop_epoch_ = stop_epoch_;
  return arrival;
}

CommandGate::Ticket CommandGate::begin(std::int64_t command_id, const Arrival& arrival) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (arrival.stop_epoch_ != stop_epoch_) throw Cancelled(text("command ", command_id, " was stopped before it began"));
  planning_.cancel();
  planning_ = CancelSource();
  newest_id_ = command_id;
  Ticket ticket;
  ticket.command_id_ = command_id;
  ticket.epoch_ = ++epoch_;
  ticket.planning_ = planning_;
  return ticket;
}

void CommandGate::requireCurrent(const Ticket& ticket) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireCurrentLocked(ticket);
}

void CommandGate::requireCurrentLocked(const Ticket& ticket) const {
  if (ticket.epoch_ <= stop_epoch_) {
    throw Cancelled(text("command ", ticket.command_id_, " was stopped while it was being planned"));
  }
  if (ticket.epoch_ != epoch_) {
    throw Superseded(text("superseded by command ", newest_id_, " while it was being planned"));
  }
}

std::optional<std::int64_t> CommandGate::commit(const Ticket& ticket, const std::function<void()>& publish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireCurrentLocked(ticket);
  publish();
  const auto replaced = last_sent_;
  last_sent_ = ticket.command_id_;
  return replaced;
}

std::optional<std::int64_t> CommandGate::stop(const std::function<void()>& publish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  stop_epoch_ = ++epoch_;
  planning_.cancel();
  if (publish) publish();
  return last_sent_;
}

std::optional<std::int64_t> CommandGate::lastSent() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_sent_;
}

}  // namespace external_command
