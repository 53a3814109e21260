// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "external_command/SpeedCommand.h"
#include "external_command/core/arrival.h"
#include "external_command/core/driving_time.h"
#include "external_command/core/path_progress.h"
#include "external_command/core/vehicle.h"
#include "external_command/ros/command_gate.h"
#include "external_command/ros/command_registry.h"
#include "external_command/ros/vehicle_pose.h"

namespace external_command {

/// What ends a motion command that the planner has taken: its report, the vehicle's pose, or whichever comes first.
enum class ArrivalSource { kReported, kPose, kBoth };

struct MotionWatchParams {
  ArrivalSource arrival = ArrivalSource::kBoth;
  ArrivalParams tolerances;
  double silence = 2.0;  ///< without a report, after which the pose counts where both do [s]

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// Where a plan begins that begins at the vehicle: where it stands, or where it will be, along the path that it is
/// driving, when the plan is done.
class PlanStart {
 public:
  explicit PlanStart(const Pose2d& pose) : pose_(pose) {}
  PlanStart(const Pose2d& pose, Path approach) : pose_(pose), approach_(std::move(approach)) {}
  explicit PlanStart(std::string why_unknown) : why_unknown_(std::move(why_unknown)) {}

  bool isKnown() const { return pose_.has_value(); }

  /// @throws NotReady  the vehicle's pose is not known.
  const Pose2d& pose() const;

  /// Of the path that the vehicle is driving: from where it was to pose(). Empty where that is the same.
  const Path& approach() const { return approach_; }

 private:
  std::optional<Pose2d> pose_;
  Path approach_;
  std::string why_unknown_;
};

/// Follows the vehicle along the path of the motion that is under way, and tells the registry how far it has come. Ends
/// the command where the planner does not but the vehicle stands at the end of its path. Thread-safe.
class MotionWatch {
 public:
  /// All must live as long as this.
  MotionWatch(const MotionWatchParams& params, const VehicleParams& vehicle, const VehiclePose& pose,
              const CommandGate& gate, CommandRegistry& registry);

  /// Looks at the vehicle; to be called some times per second.
  void look();

  /// The motion under way is to be driven so from now on, as long as it is. Orders to halt are not estimated with.
  void noteSpeed(const SpeedCommand& command);

  /// @param horizon  the time that planning takes [s]; 0: the plan begins where the vehicle is.
  PlanStart startFor(double horizon) const;

  /// What is left of the motion, from where the vehicle has come.
  Path restOf(const SentMotion& motion) const;

 private:
  void follow(const Pose2d& pose, double now);
  SpeedOrder orderFor(const SentMotion& motion) const;
  void tellProgress();
  void endWhereArrived(const Pose2d& pose, double now);

  const MotionWatchParams params_;
  const VehicleParams vehicle_;
  const VehiclePose& vehicle_pose_;
  const CommandGate& gate_;
  CommandRegistry& registry_;

  mutable std::mutex mutex_;
  VehicleMotion motion_;
  std::shared_ptr<const SentMotion> followed_;
  std::optional<PathProgress> progress_;  ///< along the path of the followed
  std::optional<DrivingTime> time_;       ///< on that path
  CommandSerial ordered_ = 0;             ///< the motion that `order_` is for
  SpeedOrder order_;
};

}  // namespace external_command
