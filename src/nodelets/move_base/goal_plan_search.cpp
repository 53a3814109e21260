// SPDX-License-Identifier: Apache-2.0
#include "goal_plan_search.h"

#include <chrono>
#include <cmath>
#include <string>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr std::chrono::seconds kSearchTime(5);  // after which nothing else is tried
constexpr double kToleranceRounding = 1e-3;     // [m]

/// What another pose near by may not have.
bool mayLieAtThePose(const CommandStatus& status) {
  switch (status.error_code) {
    case CommandStatus::OFF_MAP:
    case CommandStatus::NO_ROUTE:
    case CommandStatus::GOAL_BLOCKED:
    case CommandStatus::NO_PATH:
    case CommandStatus::PLANNING_TIMEOUT:
      return true;
    default:
      return false;
  }
}

double distanceFromEnd(const PlannedPath& path, const Pose2d& goal) {
  if (path.points.empty()) return HUGE_VAL;
  return std::hypot(path.points.back().x - goal.x, path.points.back().y - goal.y);
}

}  // namespace

std::vector<Pose2d> posesAround(const Pose2d& goal, double tolerance) {
  std::vector<Pose2d> poses = {goal};
  if (tolerance <= 0.0) return poses;
  for (const double distance : {0.5 * tolerance, tolerance}) {
    for (int i = 0; i < 8; ++i) {
      const double direction = goal.heading + i * M_PI_4;
      poses.push_back({goal.x + distance * std::cos(direction), goal.y + distance * std::sin(direction), goal.heading});
    }
  }
  return poses;
}

PlannedPath findPlan(const std::function<GoalPoseService::Answer(const GoalPoseService::Goal&)>& run,
                     GoalPoseService::Goal goal, double tolerance) {
  const auto begin = std::chrono::steady_clock::now();
  const Pose2d wanted = goal.pose;
  std::string why;
  for (const Pose2d& pose : posesAround(wanted, tolerance)) {
    goal.pose = pose;
    goal.dry_run = true;
    GoalPoseService::Answer answer = run(goal);
    const bool is_planned = answer.status.status == CommandStatus::FINISHED;
    const double distance = is_planned ? distanceFromEnd(answer.path, wanted) : HUGE_VAL;
    if (is_planned && (tolerance <= 0.0 || distance <= tolerance + kToleranceRounding)) return std::move(answer.path);
    if (why.empty()) {
      why = is_planned
                ? text("the path ends ", metres(distance), " from the goal; the tolerance is ", metres(tolerance))
                : answer.status.message;
    }
    if (!is_planned && !mayLieAtThePose(answer.status)) break;
    if (std::chrono::steady_clock::now() - begin > kSearchTime) break;
  }
  throw NoPath(why);
}

}  // namespace external_command
