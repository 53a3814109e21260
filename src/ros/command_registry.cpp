// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_registry.h"

#include <algorithm>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

/// Ids of an earlier run of this process must not come again: a planner may still report about them.
std::int64_t firstFreshId() { return static_cast<std::int64_t>(ros::WallTime::now().sec) * 1000; }

}  // namespace

CommandRegistry::CommandRegistry(Listener listener) : listener_(std::move(listener)), next_id_(firstFreshId()) {}

CommandRegistry::Admission CommandRegistry::admit(std::int64_t wanted_id, const std::string& processor,
                                                  std::uint64_t digest) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(wanted_id);
  if (known != records_.end() && !hasEnded(known->second.status)) {
    const Record& record = known->second;
    if (record.digest == digest && record.processor == processor) return {wanted_id, record.status};
    throw DuplicateId(text("command_id ", wanted_id, " belongs to a command of ", record.processor,
                           " that is still running; use another id, or 0 for a fresh one"));
  }
  Record& record = add(wanted_id, processor);
  record.digest = digest;
  const std::int64_t id = record.status.command_id;
  change(&record, makeStatus(id, CommandStatus::RUNNING, ErrorCode::kOk, "being planned"));
  return {id, std::nullopt};
}

CommandStatus CommandRegistry::refuse(CommandStatus status, const std::string& processor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(status.command_id);
  if (known != records_.end() && !hasEnded(known->second.status)) return status;
  Record& record = add(status.command_id, processor);
  status.command_id = record.status.command_id;
  change(&record, status);
  return status;
}

void CommandRegistry::markSent(std::int64_t command_id, const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(command_id);
  if (known == records_.end() || hasEnded(known->second.status)) return;
  Record& record = known->second;
  record.was_sent = true;
  record.sent_at = ros::Time::now();
  record.last_report = ros::WallTime::now();
  change(&record, makeStatus(command_id, CommandStatus::RUNNING, ErrorCode::kOk, message));
}

bool CommandRegistry::update(const CommandStatus& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(status.command_id);
  if (known == records_.end() || hasEnded(known->second.status)) return false;
  known->second.has_own_message = true;
  change(&known->second, status);
  return true;
}

void CommandRegistry::report(const CommandStatus& status, const std::string& processor) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(status.command_id);
  if (known == records_.end() || known->second.processor != processor) return;
  Record& record = known->second;
  const bool is_older = !status.header.stamp.isZero() && status.header.stamp < record.sent_at;
  if (hasEnded(record.status) || !record.was_sent || is_older) return;
  record.last_report = ros::WallTime::now();
  record.is_silent = false;
  if (status.status == CommandStatus::UNKNOWN) return;
  CommandStatus reported = status;
  if (!hasEnded(status) && record.has_own_message) reported.message = record.status.message;
  if (status.status == CommandStatus::ERROR && status.error_code == CommandStatus::OK) {
    reported.error_code = CommandStatus::REFUSED_BY_VEHICLE;
  }
  change(&record, reported);
}

void CommandRegistry::noteSilence(double limit) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::WallTime now = ros::WallTime::now();
  for (auto& [id, record] : records_) {
    if (hasEnded(record.status) || !record.was_sent || record.is_silent) continue;
    if ((now - record.last_report).toSec() < limit) continue;
    record.is_silent = true;
    CommandStatus status = record.status;
    status.header.stamp = ros::Time::now();
    status.message = text("nothing was reported about it for more than ", limit,
                          " s (~planner_silence_timeout); is the planner running? Before that: ", status.message);
    change(&record, status);
  }
}

CommandStatus CommandRegistry::find(std::int64_t command_id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(command_id);
  if (known != records_.end()) return known->second.status;
  return makeStatus(command_id, CommandStatus::UNKNOWN, ErrorCode::kUnknownId,
                    text("no command with id ", command_id, " among the last ", kCapacity));
}

CommandRegistry::Record& CommandRegistry::add(std::int64_t command_id, const std::string& processor) {
  if (command_id <= 0) {
    while (records_.count(next_id_) != 0) ++next_id_;  // a caller may have chosen it
    command_id = next_id_++;
  }
  const auto known = records_.find(command_id);
  if (known != records_.end()) {
    order_.erase(std::find(order_.begin(), order_.end(), command_id));
    records_.erase(known);
  }
  if (records_.size() >= kCapacity) forgetOldest();
  order_.push_back(command_id);
  Record& record = records_[command_id];
  record.processor = processor;
  record.status.command_id = command_id;
  return record;
}

void CommandRegistry::forgetOldest() {
  // A running command is kept: its end must still be told.
  const auto ended = [&](std::int64_t id) { return hasEnded(records_[id].status); };
  auto oldest = std::find_if(order_.begin(), order_.end(), ended);
  if (oldest == order_.end()) oldest = order_.begin();
  records_.erase(*oldest);
  order_.erase(oldest);
}

void CommandRegistry::change(Record* record, const CommandStatus& status) {
  const CommandStatus& old = record->status;
  const bool is_news =
      old.status != status.status || old.error_code != status.error_code || old.message != status.message;
  record->status = status;
  if (is_news && listener_) listener_(status);
}

}  // namespace external_command
