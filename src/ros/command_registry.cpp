// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_registry.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

/// Ids of an earlier run of this process must not come again: a planner may still report about them.
std::int64_t firstFreshId() { return static_cast<std::int64_t>(ros::WallTime::now().sec) * 1000; }

bool canBeReported(std::uint8_t status) {
  return status == CommandStatus::RUNNING || status == CommandStatus::FINISHED || status == CommandStatus::ERROR;
}

void setProgress(const std::optional<MotionProgress>& progress, CommandStatus* status) {
  const MotionProgress known = progress.value_or(MotionProgress());
  status->has_progress = progress.has_value();
  status->distance_left = known.distance_left;
  status->share_done = known.share_done;
  status->time_left = known.time_left;
}

}  // namespace

std::string silenceWords(double limit) {
  return text("nothing was reported about it for more than ", limit,
              " s (~planner_silence_timeout); is the planner running?");
}

CommandRegistry::CommandRegistry(Listener listener, ReportRules rules)
    : listener_(std::move(listener)), rules_(rules), next_id_(firstFreshId()) {}

CommandRegistry::Admission CommandRegistry::admit(std::int64_t wanted_id, const CommandOwner& owner,
                                                  std::uint64_t digest) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Record* const known = byId(wanted_id);
  if (known != nullptr && known->state != State::kEnded) {
    if (known->digest == digest && known->owner.processor == owner.processor) {
      return {{serials_.at(wanted_id), wanted_id, 0}, known->status, ""};
    }
    throw DuplicateId(text("command_id ", wanted_id, " belongs to a command of ", known->owner.processor,
                           " that is still running; use another id, or 0 for a fresh one"));
  }
  return letIn(wanted_id, owner, digest);
}

CommandRegistry::Admission CommandRegistry::admitAlways(std::int64_t wanted_id, const CommandOwner& owner) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Record* const known = byId(wanted_id);
  if (known == nullptr) return letIn(wanted_id, owner, 0);
  const std::string other = text("command_id ", wanted_id, " belongs to a command of ", known->owner.processor,
                                 " that ", known->state == State::kEnded ? "has ended" : "is still running");
  Admission admission = letIn(0, owner, 0);
  admission.note = text(other, "; this one is command ", admission.command.id);
  return admission;
}

CommandStatus CommandRegistry::refuse(CommandStatus status, const CommandOwner& owner) {
  const std::lock_guard<std::mutex> lock(mutex_);
  status.service = owner.service;
  const Record* const known = byId(status.command_id);
  if (known != nullptr && known->state != State::kEnded) return status;
  const AdmittedCommand command = add(status.command_id, owner, 0);
  status.command_id = command.id;
  change(command.serial, running(command.serial), status);
  return status;
}

void CommandRegistry::markSent(CommandSerial serial, const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Record* const record = running(serial);
  if (record == nullptr) return;
  record->state = State::kSent;
  record->sent_at = ros::Time::now();
  record->last_report = ros::SteadyTime::now();
  record->said = message;
  say(serial, record);
}

void CommandRegistry::noteAnswer(CommandSerial serial, const std::string& message) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Record* const record = running(serial);
  if (record == nullptr || record->state != State::kPlanned) return;
  record->said = message;
  say(serial, record);
}

void CommandRegistry::noteProgress(CommandSerial serial, const std::optional<MotionProgress>& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Record* const record = running(serial);
  if (record == nullptr || record->state != State::kSent) return;
  record->driven = progress;
  setProgress(progress, &record->status);
  record->status.header.stamp = ros::Time::now();
}

bool CommandRegistry::update(const StatusChange& update) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Record* const record = running(update.serial);
  if (record == nullptr) return false;
  if (hasEnded(update.status)) {
    change(update.serial, record, update.status);
  } else {
    record->progress = update.status.message;
    say(update.serial, record);
  }
  return true;
}

bool CommandRegistry::report(const CommandStatus& status, const std::string& processor) {
  if (!canBeReported(status.status)) return false;
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = serials_.find(status.command_id);
  if (known == serials_.end()) return true;
  const CommandSerial serial = known->second;
  Record* const record = running(serial);
  if (record == nullptr || record->owner.processor != processor || record->state != State::kSent) return true;
  if (isOlder(status.header.stamp, record->sent_at, record->skew)) return true;
  record->last_report = ros::SteadyTime::now();
  record->silence.clear();
  if (status.status == CommandStatus::RUNNING || (status.status == CommandStatus::FINISHED && !rules_.may_finish)) {
    record->said = status.message;
    say(serial, record);
    return true;
  }
  change(serial, record, endFromReport(status.command_id, status));
  return true;
}

void CommandRegistry::noteSilence(double limit) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const ros::SteadyTime now = ros::SteadyTime::now();
  for (auto& [serial, record] : records_) {
    if (record.state != State::kSent || !record.silence.empty()) continue;
    if ((now - record.last_report).toSec() < limit) continue;
    record.silence = silenceWords(limit) + " Before that: ";
    say(serial, &record);
  }
}

std::optional<CommandStatus> CommandRegistry::newest() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return records_.empty() ? std::nullopt : std::optional<CommandStatus>(records_.rbegin()->second.status);
}

std::vector<CommandStatus> CommandRegistry::running() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<CommandStatus> running;
  for (const auto& [serial, record] : records_) {
    if (record.state != State::kEnded) running.push_back(record.status);
  }
  return running;
}

CommandStatus CommandRegistry::find(std::int64_t command_id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const Record* const known = byId(command_id);
  if (known != nullptr) return known->status;
  return makeStatus(command_id, CommandStatus::UNKNOWN, ErrorCode::kUnknownId,
                    text("no command with id ", command_id, " is running, or among the last ", kCapacity));
}

std::optional<CommandStatus> CommandRegistry::statusOf(CommandSerial serial) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(serial);
  return known == records_.end() ? std::nullopt : std::optional<CommandStatus>(known->second.status);
}

bool CommandRegistry::isRunning(CommandSerial serial) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(serial);
  return known != records_.end() && known->second.state != State::kEnded;
}

void CommandRegistry::requireRunning(const AdmittedCommand& command) const {
  if (isRunning(command.serial)) return;
  throw Cancelled(text("command ", command.id, " was cancelled before anything of it was sent"));
}

std::optional<CommandSerial> CommandRegistry::serialOf(std::int64_t command_id) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = serials_.find(command_id);
  return known == serials_.end() ? std::nullopt : std::optional<CommandSerial>(known->second);
}

double CommandRegistry::silenceOf(CommandSerial serial) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto known = records_.find(serial);
  if (known == records_.end() || known->second.state != State::kSent) return 0.0;
  return (ros::SteadyTime::now() - known->second.last_report).toSec();
}

CommandRegistry::Record* CommandRegistry::running(CommandSerial serial) {
  const auto known = records_.find(serial);
  return known == records_.end() || known->second.state == State::kEnded ? nullptr : &known->second;
}

const CommandRegistry::Record* CommandRegistry::byId(std::int64_t command_id) const {
  const auto known = serials_.find(command_id);
  return known == serials_.end() ? nullptr : &records_.at(known->second);
}

CommandRegistry::Admission CommandRegistry::letIn(std::int64_t wanted_id, const CommandOwner& owner,
                                                  std::uint64_t digest) {
  const AdmittedCommand command = add(wanted_id, owner, digest);
  say(command.serial, running(command.serial));
  return {command, std::nullopt, ""};
}

/// The record of an ended command by the same id gives way.
AdmittedCommand CommandRegistry::add(std::int64_t command_id, const CommandOwner& owner, std::uint64_t digest) {
  if (command_id <= 0) {
    while (serials_.count(next_id_) != 0) ++next_id_;  // a caller may have chosen it
    command_id = next_id_++;
  }
  const CommandSerial serial = ++last_serial_;
  Record& record = records_.emplace(serial, owner).first->second;
  const auto [known, is_new] = serials_.emplace(command_id, serial);
  record.skew = is_new ? rules_.clock_skew : 0.0;  // a planner may still report about the earlier command by this id
  if (!is_new) {
    ended_.erase(std::find(ended_.begin(), ended_.end(), known->second));
    records_.erase(known->second);
    known->second = serial;
  }
  record.digest = digest;
  record.said = "being planned";
  record.status.command_id = command_id;
  record.status.service = owner.service;
  return {serial, command_id, 0};
}

void CommandRegistry::say(CommandSerial serial, Record* record) {
  const std::string& message = record->progress.empty() ? record->said : record->progress;
  change(serial, record,
         makeStatus(record->status.command_id, CommandStatus::RUNNING, ErrorCode::kOk, record->silence + message));
}

void CommandRegistry::change(CommandSerial serial, Record* record, const CommandStatus& status) {
  const CommandStatus& old = record->status;
  const bool is_news =
      old.status != status.status || old.error_code != status.error_code || old.message != status.message;
  const std::int64_t id = old.command_id;
  record->status = status;
  record->status.command_id = id;
  record->status.service = record->owner.service;
  if (hasEnded(status)) {
    const bool has_arrived = status.status == CommandStatus::FINISHED && record->state == State::kSent;
    record->driven = has_arrived ? std::optional<MotionProgress>({0.0, 1.0, 0.0}) : std::nullopt;
  }
  setProgress(record->driven, &record->status);  // a planner's own words on it do not count
  const CommandStatus told = record->status;
  if (hasEnded(status)) {
    record->state = State::kEnded;
    ended_.push_back(serial);
    forgetOldest();
  }
  if (is_news && listener_) listener_(serial, told);
}

void CommandRegistry::forgetOldest() {
  if (ended_.size() <= kCapacity) return;
  const CommandSerial oldest = ended_.front();
  ended_.pop_front();
  serials_.erase(records_.at(oldest).status.command_id);
  records_.erase(oldest);
}

}  // namespace external_command
