// SPDX-License-Identifier: Apache-2.0
#include "nodelets/move_base/goal_plan_search.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"

namespace external_command {
namespace {

double distance(const Pose2d& a, const Pose2d& b) { return (a.position() - b.position()).norm(); }

/// A service that refuses goals with less than `free_from` as x, and ends `aside` from those it takes.
class Service {
 public:
  GoalPoseService::Answer operator()(const GoalPoseService::Goal& goal) {
    ++calls;
    EXPECT_TRUE(goal.dry_run);
    GoalPoseService::Answer answer;
    const bool is_taken = goal.pose.x >= free_from;
    answer.status.status = is_taken ? CommandStatus::FINISHED : CommandStatus::ERROR;
    if (!is_taken) answer.status.error_code = code;
    answer.status.message = "blocked";
    PathPoint last;
    last.x = goal.pose.x;
    last.y = goal.pose.y + aside;
    if (is_taken) answer.path.points.push_back(last);
    return answer;
  }

  double free_from = -100.0;
  double aside = 0.0;
  std::uint16_t code = CommandStatus::GOAL_BLOCKED;
  int calls = 0;
};

class GoalPlanSearch : public testing::Test {
 protected:
  PlannedPath find(double tolerance) {
    GoalPoseService::Goal goal;
    goal.pose = goal_;
    return findPlan(std::ref(service_), goal, tolerance);
  }

  std::string whyNone(double tolerance) {
    try {
      find(tolerance);
    } catch (const NoPath& error) {
      return error.what();
    }
    return "there is one";
  }

  const Pose2d goal_{10.0, 20.0, 0.3};
  Service service_;
};

TEST_F(GoalPlanSearch, TakesTheGoalItselfWhereItCan) {
  EXPECT_EQ(find(5.0).points.back().x, goal_.x);
  EXPECT_EQ(find(0.0).points.back().x, goal_.x);
  EXPECT_EQ(service_.calls, 2);
}

TEST_F(GoalPlanSearch, TakesTheNearestPoseWithinTheToleranceWhereTheGoalIsBlocked) {
  service_.free_from = 11.0;
  EXPECT_NEAR(find(4.0).points.back().x, 12.0, 0.2);
  service_.free_from = 13.0;
  EXPECT_NEAR(find(4.0).points.back().x, 14.0, 0.5);
}

TEST_F(GoalPlanSearch, TellsWhyTheGoalIsRefusedWhereNoOtherPoseWillDo) {
  service_.free_from = 20.0;
  EXPECT_EQ(whyNone(4.0), "blocked");
  EXPECT_EQ(service_.calls, 17);
}

TEST_F(GoalPlanSearch, TriesNothingElseWithoutATolerance) {
  service_.free_from = 20.0;
  EXPECT_EQ(whyNone(0.0), "blocked");
  EXPECT_EQ(service_.calls, 1);
}

TEST_F(GoalPlanSearch, TriesNothingElseWhereTheGoalIsNotToBlame) {
  service_.free_from = 20.0;
  service_.code = CommandStatus::NOT_READY;
  EXPECT_EQ(whyNone(4.0), "blocked");
  EXPECT_EQ(service_.calls, 1);
}

TEST_F(GoalPlanSearch, TakesNoPathThatEndsBeyondTheTolerance) {
  service_.aside = 3.0;
  EXPECT_EQ(find(0.0).points.size(), 1U);
  EXPECT_NE(whyNone(1.0).find("the path ends 3.00 m from the goal"), std::string::npos) << whyNone(1.0);
  EXPECT_LE(std::hypot(find(3.5).points.back().x - goal_.x, find(3.5).points.back().y - goal_.y), 3.5);
}

TEST(PosesAround, AreTheGoalAndTwoRings) {
  const Pose2d goal{1.0, 2.0, 0.5};
  const auto poses = posesAround(goal, 4.0);
  ASSERT_EQ(poses.size(), 17U);
  EXPECT_EQ(distance(poses[0], goal), 0.0);
  for (std::size_t i = 1; i < poses.size(); ++i) {
    EXPECT_NEAR(distance(poses[i], goal), i <= 8 ? 2.0 : 4.0, 1e-9);
    EXPECT_EQ(poses[i].heading, goal.heading);
  }
}

}  // namespace
}  // namespace external_command
