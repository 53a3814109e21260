// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_gate.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::size_t kMostUnshown = 16;

std::string uniqueName() {
  static std::atomic<int> gates{0};
  return text(getpid(), "-", ros::WallTime::now().toNSec(), "-", ++gates);
}

}  // namespace

CommandGate::CommandGate() : name_(uniqueName()) {}

bool CommandGate::wasStoppedSince(const ros::WallTime& time) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return !last_stop_.isZero() && last_stop_ >= time;
}

void CommandGate::requireNewest(const AdmittedCommand& command) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireNewestLocked(command);
}

void CommandGate::sendUnlessStopped(const AdmittedCommand& command, const std::function<void()>& publish) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireNotStoppedLocked(command);
  publish();
}

void CommandGate::requireNotStoppedLocked(const AdmittedCommand& command) const {
  if (command.arrival > stopped_) return;
  throw Cancelled(text("command ", command.id, " arrived before a stop; nothing of it was sent"));
}

void CommandGate::requireNewestLocked(const AdmittedCommand& command) const {
  requireNotStoppedLocked(command);
  if (command.arrival < newest_.arrival) {
    throw Superseded(text("superseded by command ", newest_.id, ", which arrived later; nothing of command ",
                          command.id, " was sent"));
  }
}

CommandGate::Planning::Planning(CommandGate* gate, Kind kind, const AdmittedCommand& command,
                                const CancelSource& source)
    : gate_(*gate) {
  const std::lock_guard<std::mutex> lock(gate_.mutex_);
  if (kind == Kind::kMotion) gate_.requireNewestLocked(command);
  work_ = gate_.works_.insert(gate_.works_.end(), {kind, command, source});
}

CommandGate::Planning::~Planning() {
  const std::lock_guard<std::mutex> lock(gate_.mutex_);
  gate_.works_.erase(work_);
}

const AdmittedCommand& CommandGate::Planning::command() const { return work_->command; }

CancelToken CommandGate::Planning::cancelToken() const { return work_->source.token(); }

CommandGate::Ticket CommandGate::begin(const Planning& planning) {
  const AdmittedCommand& command = planning.command();
  const std::lock_guard<std::mutex> lock(mutex_);
  requireNewestLocked(command);
  planning.cancelToken().throwIfCancelled();
  endWorkLocked([&](const Work& work) {
    const bool is_older = work.command.arrival <= command.arrival && work.command.serial != command.serial;
    return is_older && work.kind == Planning::Kind::kMotion;
  });
  newest_ = command;
  newest_began_ = stamp();
  Ticket ticket;
  ticket.command_ = command;
  ticket.cancel_ = planning.cancelToken();
  return ticket;
}

std::shared_ptr<const SentMotion> CommandGate::commit(const Ticket& ticket, std::shared_ptr<const SentMotion> motion,
                                                      const std::function<void()>& publish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  requireNewestLocked(ticket.command_);
  ticket.cancelToken().throwIfCancelled();
  publish();
  if (motion_ && motion_->topics && motion->topics) motion->topics->replace(*motion_->topics);
  last_motion_ = ticket.command_.serial;
  unshown_.push_back(motion);
  if (unshown_.size() > kMostUnshown) unshown_.pop_front();
  motion_.swap(motion);
  return motion;
}

std::shared_ptr<const SentMotion> CommandGate::stop(bool withdraws, const std::function<void()>& publish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  stopped_ = *arrivals_;
  last_stop_ = ros::WallTime::now();
  endWorkLocked([](const Work& work) { return work.kind == Planning::Kind::kMotion; });
  if (publish) publish();
  if (withdraws) withdrawLocked();
  return motion_;
}

void CommandGate::cancel(CommandSerial serial, const std::function<bool()>& end,
                         const std::function<void(const ros::Time& stamp)>& clear) {
  const std::lock_guard<std::mutex> lock(mutex_);
  endWorkLocked([&](const Work& work) { return work.command.serial == serial; });
  if (!end() || !motion_ || motion_->command.serial != serial) return;
  const ros::Time now = stamp();  // simulated time may have been set back
  clear(newest_.serial == serial ? now : std::min(now, newest_began_));
  withdrawLocked();
  motion_.reset();
}

void CommandGate::endWorkLocked(const std::function<bool(const Work&)>& is_meant) {
  for (const Work& work : works_) {
    if (is_meant(work)) work.source.cancel();
  }
}

/// What came before the motion under way must not be shown behind its withdrawal.
void CommandGate::withdrawLocked() {
  unshown_.clear();
  if (motion_ && motion_->topics) motion_->topics->withdraw();
}

void CommandGate::retire(CommandSerial serial) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!motion_ || motion_->command.serial != serial) return;
  withdrawLocked();
  motion_.reset();
}

void CommandGate::showAgain(CommandSerial serial, const Path& rest) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (motion_ && motion_->command.serial == serial && motion_->topics) motion_->topics->showAgain(rest);
}

std::shared_ptr<const SentMotion> CommandGate::unshown() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return unshown_.empty() ? nullptr : unshown_.front();
}

void CommandGate::show(const SentMotion& motion, const std::function<void()>& publish) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (unshown_.empty() || unshown_.front().get() != &motion) return;
  unshown_.pop_front();
  publish();
}

CommandSerial CommandGate::lastMotion() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return last_motion_;
}

std::shared_ptr<const SentMotion> CommandGate::motion() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return motion_;
}

}  // namespace external_command
