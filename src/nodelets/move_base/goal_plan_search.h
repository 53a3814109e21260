// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "external_command/PlannedPath.h"
#include "goal_pose_service.h"

namespace external_command {

/// The goal itself, then poses around it: eight half as far from it as `tolerance` [m], eight that far.
std::vector<Pose2d> posesAround(const Pose2d& goal, double tolerance);

/// Dry runs until one ends within `tolerance` [m] of the goal: to the goal, then to poses around it.
/// @param run        plans to a goal.
/// @param tolerance  0: the path may end wherever the service takes the goal to be, and nothing else is tried.
/// @throws NoPath  there is none; the text says what is wrong with the goal itself.
PlannedPath findPlan(const std::function<GoalPoseService::Answer(const GoalPoseService::Goal&)>& run,
                     GoalPoseService::Goal goal, double tolerance);

}  // namespace external_command
