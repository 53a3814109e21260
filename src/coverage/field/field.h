// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "coverage/path/curve.h"
#include "external_command/coverage/coverage_planner.h"
#include "external_command/motion/collision_checker.h"
#include "external_command/motion/region.h"
#include "geometry.h"
#include "grid.h"

namespace external_command {

/// The area, the vehicle and what is wanted, in a frame with its origin in the area, so that no digits are lost.
/// Immutable but for the cancel token's state.
class Field {
 public:
  /// @throws InvalidRequest, StartBlocked  as CoveragePlanner::plan().
  Field(const VehicleParams& vehicle, const CoverageParams& params, const CoverageArea& area,
        const std::optional<Pose2d>& start, const CancelToken& cancel);

  const VehicleParams& vehicle() const { return vehicle_; }
  const CoverageParams& params() const { return params_; }
  const CancelToken& cancel() const { return cancel_; }
  /// To be called in every loop. @throws Cancelled, PlanningTimeout
  void poll() const;
  Checkpoint checkpoint() const {
    return [this] { poll(); };
  }
  double timeUsed() const;  ///< as share of the budget

  const Point2d& origin() const { return origin_; }
  const std::optional<Pose2d>& start() const { return start_; }
  const std::string& startWarning() const { return start_warning_; }  ///< empty where the start keeps the margin

  const shapes::Shapes& free() const { return free_; }
  const shapes::Shapes& goal() const { return goal_; }          ///< what the tool can reach from the start
  const shapes::Shapes& workable() const { return workable_; }  ///< the free parts that `goal` lies in
  /// `workable` without the small holes: those round which a lap would bend more than the vehicle can, and that a swath
  /// can be bent round by mostShift().
  const shapes::Shapes& passable() const { return passable_; }
  const Region& region() const { return region_; }

  double width() const { return params_.swath_width; }
  double radius() const { return vehicle_.min_turning_radius; }
  double gearPrice() const;                                                      ///< of a change of gear, as length [m]
  double mostShift() const;                                                      ///< of a swath past a small hole [m]
  double front() const { return vehicle_.wheelbase + vehicle_.front_overhang; }  ///< rear axle to the nose [m]

  bool isFree(const Pose2d& pose) const { return checker_.isFree(pose); }
  bool isFree(const Curve& curve) const;

  /// As isFree(), but without a margin: for the way out of a tight start.
  bool isBarelyFree(const Curve& curve) const;

  /// The longest part of a curve on which the vehicle is free, looked at every `step` [m]; empty where it nowhere is.
  Curve freePart(const Curve& curve, double step) const;

  /// A grid with kFree, kGoal, kOpen and kPassable set.
  CoverageGrid makeGrid() const;

 private:
  void setShapes(const CoverageArea& area);
  void setGoal();
  void setPassable();
  void requireFreeStart(const CoverageArea& area);

  VehicleParams vehicle_;
  CoverageParams params_;
  CancelToken cancel_;
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  Point2d origin_;
  std::optional<Pose2d> start_;
  std::string start_warning_;
  double reach_;  ///< rear axle to the farthest corner [m]
  shapes::Shapes free_;
  shapes::Shapes goal_;
  shapes::Shapes workable_;
  shapes::Shapes passable_;
  Region region_;
  CollisionChecker checker_;
  CollisionChecker bare_checker_;
};

}  // namespace external_command
