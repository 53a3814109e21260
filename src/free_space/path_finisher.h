// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "driving_cost.h"
#include "external_command/free_space/free_space_planner.h"
#include "stop_condition.h"

namespace external_command {

/// Arcs that were found, to one of the goals.
struct FoundWay {
  Arcs arcs;
  std::size_t goal_index;
  Query query;
};

/// Makes paths of arcs: with gradual steering, points and the last check. Refers to its arguments.
class PathFinisher {
 public:
  /// @param ends  in the frame of the scene.
  PathFinisher(const Scene& scene, const DrivingCost& cost, const VehicleParams& vehicle, const FreeSpaceParams& params,
               const EndStates& ends, const StopCondition& stop);

  /// The way as a path in the frame of the scene, checked; with as much of gradual steering as passes the check.
  /// @throws NoPath  it fails the last check.
  FreeSpacePlan finish(const FoundWay& way) const;

 private:
  struct Drive;
  struct Checked;

  std::vector<Drive> drivesOf(const FoundWay& way) const;
  std::optional<Drive> withRamps(const Drive& drive, const Pose2d& start) const;
  Checked checked(const FoundWay& way, const Drive& drive) const;
  bool keepsMargin(const Pose2d& from, const Arcs& arcs) const;

  const Scene& scene_;
  const DrivingCost& cost_;
  const VehicleParams& vehicle_;
  const FreeSpaceParams& params_;
  const EndStates& ends_;
  const StopCondition& stop_;
};

}  // namespace external_command
