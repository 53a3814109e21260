// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_watch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"
#include "external_command/ros/status.h"
#include "external_command/ros/steady_time.h"

namespace external_command {

namespace {

constexpr double kMoving = 0.2;      // a slower vehicle stands [m/s]
constexpr double kStood = 0.3;       // at one place, after which it stands, whatever its average speed still is [s]
constexpr double kOnPath = 1.0;      // of the vehicle to the path that it is said to drive, at most [m]
constexpr double kReserve = 1.0;     // beyond the way that stopping takes [m]
constexpr double kUnfollowed = 1.0;  // of the path's end, that need not be driven to have arrived [m]

bool changesGear(const Path& path, std::size_t i) {
  return i > 0 && i + 1 < path.size() && path[i].direction != path[i + 1].direction;
}

}  // namespace

void MotionWatchParams::validate() const {
  tolerances.validate();
  requireParameter("arrival_silence", silence, 0.0, 3600.0);
}

const Pose2d& PlanStart::pose() const {
  if (!pose_) throw NotReady(why_unknown_);
  return *pose_;
}

MotionWatch::MotionWatch(const MotionWatchParams& params, const VehicleParams& vehicle, const VehiclePose& pose,
                         const CommandGate& gate, CommandRegistry& registry)
    : params_(params), vehicle_(vehicle), vehicle_pose_(pose), gate_(gate), registry_(registry) {}

void MotionWatch::look() {
  Pose2d pose;
  try {
    pose = vehicle_pose_.get();
  } catch (const Error&) {
    // Who needs the pose tells why it is missing.
    if (const auto motion = gate_.motion()) registry_.noteProgress(motion->command.serial, std::nullopt);
    return;
  }
  const double now = steadyNow();
  const std::lock_guard<std::mutex> lock(mutex_);
  motion_.update(pose, now);
  follow(pose, now);
  if (!followed_) return;
  tellProgress();
  endWhereArrived(pose, now);
}

void MotionWatch::follow(const Pose2d& pose, double now) {
  auto motion = gate_.motion();
  if (!motion) {
    followed_.reset();
    progress_.reset();
    time_.reset();
    return;
  }
  if (motion != followed_) {
    progress_.emplace(motion->path);
    time_.emplace(vehicle_, motion->path, orderFor(*motion));
  }
  followed_ = std::move(motion);
  progress_->update(pose, now);
}

SpeedOrder MotionWatch::orderFor(const SentMotion& motion) const {
  return motion.command.serial == ordered_ ? order_ : SpeedOrder();
}

void MotionWatch::noteSpeed(const SpeedCommand& command) {
  const auto motion = gate_.motion();
  if (!motion) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  order_ = orderFor(*motion);
  ordered_ = motion->command.serial;
  if (command.kind == SpeedCommand::TARGET_SPEED) order_.most = command.target_speed;
  if (command.kind == SpeedCommand::RESTORE_TARGET_SPEED) order_ = SpeedOrder();
  if (command.kind == SpeedCommand::TARGET_SPEED_FACTOR && command.target_speed_factor > 0.0) {
    order_.factor = command.target_speed_factor;
  }
  if (followed_ == motion) time_.emplace(vehicle_, motion->path, order_);
}

void MotionWatch::tellProgress() {
  registry_.noteProgress(followed_->command.serial, MotionProgress{progress_->lengthLeft(), progress_->shareDone(),
                                                                   time_->left(progress_->along(), motion_.speed())});
}

void MotionWatch::endWhereArrived(const Pose2d& pose, double now) {
  if (params_.arrival == ArrivalSource::kReported) return;
  const CommandSerial serial = followed_->command.serial;
  if (params_.arrival == ArrivalSource::kBoth && registry_.silenceOf(serial) < params_.silence) return;
  if (progress_->lengthLeft() > kUnfollowed + params_.tolerances.along) return;
  const EndError error = endError(pose, followed_->path->back());
  const double rest = motion_.rest(now);
  if (!isWithin(error, params_.tolerances) || rest < params_.tolerances.rest) return;
  registry_.update(
      {serial, makeStatus(followed_->command.id, CommandStatus::FINISHED, ErrorCode::kOk,
                          text("the vehicle's pose tells it, not the planner: it has stood for ", seconds(rest),
                               " at the end of the path, ", metres(error.along), " along, ", metres(error.across),
                               " across and ", radians(error.heading), " off (~arrival)"))});
}

PlanStart MotionWatch::startFor(double horizon) const {
  Pose2d pose;
  try {
    pose = vehicle_pose_.get();
  } catch (const NotReady& error) {
    return PlanStart(error.what());
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  const double speed = motion_.speed();
  const bool stands = speed < kMoving || motion_.rest(steadyNow()) >= kStood;
  if (horizon <= 0.0 || stands || !followed_ || followed_ != gate_.motion()) return PlanStart(pose);
  const Path& path = *followed_->path;
  PathProgress progress = *progress_;
  progress.update(pose, steadyNow());
  const std::size_t here = progress.reached();
  if ((path[here].pose().position() - pose.position()).norm() > kOnPath) return PlanStart(pose);
  // There the vehicle can stop, whatever the plan begins with.
  const double stopping = speed * speed / (2.0 * vehicle_.max_deceleration) + kReserve;
  const double ahead = path[here].s + std::max(speed * horizon, stopping);
  std::size_t there = here;
  while (there + 1 < path.size() && path[there].s < ahead && !(there > here && changesGear(path, there))) ++there;
  if (there == here) return PlanStart(pose);
  return {path[there].pose(), Path(path.begin() + static_cast<std::ptrdiff_t>(here),
                                   path.begin() + static_cast<std::ptrdiff_t>(there) + 1)};
}

Path MotionWatch::restOf(const SentMotion& motion) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const bool is_followed = followed_ && followed_->command.serial == motion.command.serial;
  const std::size_t reached = is_followed ? progress_->reached() : 0;
  return Path(motion.path->begin() + static_cast<std::ptrdiff_t>(reached), motion.path->end());
}

}  // namespace external_command
