// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/deadline.h"
#include "external_command/free_space/free_space_planner.h"
#include "external_command/free_space/planner_log.h"
#include "external_command/ros/motion_command_processor.h"

namespace external_command {

/// How a processor takes the live obstacle grid.
struct ObstacleGridParams {
  std::string topic;                ///< empty: there is none
  double max_age = 2.0;             ///< an older grid counts as missing [s]; 0: none does
  bool unknown_is_blocked = true;   ///< see OccupancyGrid
  bool outside_is_blocked = false;  ///< see OccupancyGrid
};

/// The free-space planner as processors use it: with parameters, the live obstacle grid, and a display of what stood in
/// the way. Thread-safe.
class ManoeuvrePlanner {
 public:
  /// Reads the parameters `free_space/...` of a processor, and those of ObstacleGridParams.
  /// @throws InvalidParameter
  ManoeuvrePlanner(ros::NodeHandle nh, const ParameterReader& reader, ProcessContext& context);
  ~ManoeuvrePlanner();

  const FreeSpaceParams& params() const { return params_; }
  const RegionLimits& regionLimits() const { return region_limits_; }

  /// The live obstacle grid; nullopt where none is configured.
  /// @throws NotReady  it has not come, is too old or of the future, lies in an unknown frame, or has a gridFault().
  std::optional<OccupancyGrid> grid() const;

  bool hasGrid() const { return !grid_params_.topic.empty(); }

  /// How it stands with the grid, where one is configured. @throws NotReady  as grid()
  std::string gridWords() const;

  /// `parts` with the live obstacle grid added, where one is configured.
  /// @throws NotReady  as grid()
  Region regionOf(Region::Parts parts) const;

  /// How much of a path before or behind a manoeuvre may be bent [m]; see PathJoint.
  double bendLength() const;

  /// By when a command that is begun now is to be planned, all its manoeuvres together.
  Deadline deadline() const { return Deadline(params_.time_budget); }

  /// The cheapest manoeuvre from `start` to one of `goals` that is found by `deadline`. A start or goal that is blocked
  /// is shown in rviz together with `scene`. @param ends  what leads up to it and on from it. @param checked  as
  /// FreeSpacePlanner::plan().
  /// @throws  as FreeSpacePlanner::plan()
  FreeSpacePlan plan(const Pose2d& start, const std::vector<Pose2d>& goals, const Region& region,
                     const Deadline& deadline, const CancelToken& cancel, const CommandScene& scene,
                     const EndStates& ends = {}, const std::function<void()>& checked = {}) const;

  /// Shows in rviz what stands in the way of `poses`, together with `scene`.
  /// @throws Cancelled
  void showConflicts(const std::vector<Pose2d>& poses, const Region& region, CommandScene scene,
                     const CancelToken& cancel) const;

  /// Adds a manoeuvre to the end of the plan's path, and what is to be told of it to the report.
  void append(const FreeSpacePlan& manoeuvre, MotionPlan* plan) const;

 private:
  struct LatestGrid;
  struct PlacedGrid;

  /// @throws NotReady  as grid()
  PlacedGrid requireGrid() const;

  /// @throws NotReady  a grid of that stamp is too old, or of the future.
  void requireFresh(ros::Time stamp) const;

  ProcessContext& context_;
  FreeSpaceParams params_;
  RegionLimits region_limits_;
  ObstacleGridParams grid_params_;
  std::shared_ptr<LatestGrid> latest_grid_;
  ros::Subscriber grid_subscriber_;
  const std::shared_ptr<PlannerLog> planner_log_;
};

/// What to tell where a part of a command has run out of the time that it was given.
/// @param why        as the part tells it.
/// @param part       what it was given [s]
/// @param whole      the budget of the command [s]
/// @param parameter  that sets it, below the processor.
std::string timeoutWords(const std::string& why, double part, double whole, const std::string& parameter);

/// @throws InvalidParameter
FreeSpaceParams readFreeSpaceParams(const ParameterReader& reader);
RegionLimits readRegionLimits(const ParameterReader& reader);

/// Outlines of a region for the display.
void showRegion(const Region& region, CommandScene* scene);

}  // namespace external_command
