// SPDX-License-Identifier: Apache-2.0
// Of the plans that programs for move_base ask for few wait, and none holds up the unloading of what makes them. Of the
// goals the newest waits, and is driven to only while the adapter is loaded.
#include <geometry_msgs/PoseStamped.h>
#include <gtest/gtest.h>
#include <nav_msgs/GetPlan.h>
#include <ros/ros.h>

#include <chrono>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "external_command/PlanningCommand.h"
#include "support/blocking_nodelets.h"
#include "support/comes_true.h"
#include "support/inbox.h"
#include "support/nodelet_manager.h"

namespace external_command {
namespace {

constexpr const char* kService = "move_base/make_plan";
constexpr const char* kGoalTopic = "move_base_simple/goal";
constexpr const char* kAdapter = "move_base_adapter";
constexpr unsigned kMostInLine = 5;  // one in work, four that wait
constexpr std::chrono::seconds kLongest(10);

/// The adapter, and a lane follow that plans until the test lets it go on.
class MoveBaseAdapterLoaded : public testing::Test {
 protected:
  void SetUp() override {
    manager_.provide("test/BlockingLaneFollow", &lane_follow_);
    ASSERT_TRUE(manager_.load("lane_follow", "test/BlockingLaneFollow"));
    ASSERT_TRUE(manager_.load(kAdapter, "external_command/MoveBaseAdapter"));
    ASSERT_TRUE(ros::service::waitForService(kService, 10000));
  }

  void TearDown() override {
    if (gate_) gate_->open();
    manager_.clear();
  }

  boost::shared_ptr<BlockingLaneFollow> lane_follow_;
  std::shared_ptr<TestGate> gate_;
  NodeletManager manager_;
};

class MakePlan : public MoveBaseAdapterLoaded {
 protected:
  void SetUp() override {
    MoveBaseAdapterLoaded::SetUp();
    gate_ = lane_follow_->holdPlans(true);
  }

  /// How many poses the plan has: 0 where there is none.
  static std::future<std::size_t> ask() {
    return std::async(std::launch::async, [] {
      nav_msgs::GetPlan call;
      call.request.goal.header.frame_id = "map";
      call.request.goal.pose.position.x = 10.0;
      call.request.goal.pose.orientation.w = 1.0;
      ros::service::call(kService, call);  // fails where the service is taken back meanwhile
      return call.response.plan.poses.size();
    });
  }
};

class MoveBaseGoal : public MoveBaseAdapterLoaded {
 protected:
  /// A goal in work, whose plan does not end where it is cancelled, and a newer one that waits for its end.
  void SetUp() override {
    MoveBaseAdapterLoaded::SetUp();
    gate_ = lane_follow_->holdPlans(false);
    publisher_ = ros::NodeHandle().advertise<geometry_msgs::PoseStamped>(kGoalTopic, 1);
    ASSERT_TRUE(comesTrue([this] { return publisher_.getNumSubscribers() > 0; }));
    publishGoal();
    ASSERT_TRUE(gate_->waitForEntered(1));
    publishGoal();
    ASSERT_TRUE(gate_->waitForCancel());
  }

  void publishGoal() {
    geometry_msgs::PoseStamped goal;
    goal.header.frame_id = "map";
    goal.pose.position.x = 10.0;
    goal.pose.orientation.w = 1.0;
    publisher_.publish(goal);
  }

  ros::Publisher publisher_;
  Inbox<PlanningCommand> commands_{"planning/command"};
};

TEST_F(MakePlan, AnswersOneAfterTheOther) {
  std::vector<std::future<std::size_t>> asked;
  for (unsigned i = 0; i < kMostInLine; ++i) asked.push_back(ask());
  ASSERT_TRUE(gate_->waitForEntered(1));
  gate_->open();
  for (auto& answer : asked) EXPECT_GT(answer.get(), 0u);
}

TEST_F(MakePlan, RefusesAtOnceWhatIsBeyondThoseThatMayWait) {
  constexpr unsigned kMore = 20;
  std::vector<std::future<std::size_t>> asked;
  for (unsigned i = 0; i < kMostInLine + kMore; ++i) asked.push_back(ask());
  ASSERT_TRUE(gate_->waitForEntered(1));
  unsigned refused = 0;
  const auto latest = std::chrono::steady_clock::now() + kLongest;
  while (refused < kMore && std::chrono::steady_clock::now() < latest) {
    for (auto& answer : asked) {
      if (!answer.valid() || answer.wait_for(std::chrono::milliseconds(1)) != std::future_status::ready) continue;
      EXPECT_EQ(answer.get(), 0u);
      ++refused;
    }
  }
  EXPECT_EQ(refused, kMore) << "though the plan in work has not ended";
  gate_->open();
  for (auto& answer : asked) {
    if (!answer.valid()) continue;
    EXPECT_GT(answer.get(), 0u);
  }
}

TEST_F(MakePlan, EndsWhereWhatMakesItIsUnloaded) {
  std::vector<std::future<std::size_t>> asked;
  for (unsigned i = 0; i < kMostInLine; ++i) asked.push_back(ask());
  ASSERT_TRUE(gate_->waitForEntered(1));
  auto unloaded = std::async(std::launch::async, [this] { return manager_.unload(kAdapter); });
  EXPECT_EQ(unloaded.wait_for(std::chrono::seconds(1)), std::future_status::ready)
      << "though nobody opened the gate of the plan in work";
  EXPECT_EQ(gate_->entered(), 1u) << "those that wait are not planned any more";
  gate_->open();
  EXPECT_TRUE(unloaded.get());
  for (auto& answer : asked) EXPECT_EQ(answer.get(), 0u);
}

TEST_F(MoveBaseGoal, IsDrivenToOnceTheOlderOneHasEnded) {
  gate_->open();
  EXPECT_TRUE(gate_->waitForLeft(2));
  ASSERT_TRUE(commands_.waitFor(1));
}

TEST_F(MoveBaseGoal, ThatWaitsIsNotDrivenToWhereTheAdapterIsUnloaded) {
  auto unloaded = std::async(std::launch::async, [this] { return manager_.unload(kAdapter); });
  EXPECT_EQ(unloaded.wait_for(std::chrono::milliseconds(100)), std::future_status::timeout)
      << "before the one in work has ended";
  gate_->open();
  EXPECT_TRUE(unloaded.get());
  EXPECT_EQ(gate_->entered(), 1u);
  EXPECT_TRUE(commands_.messages().empty());
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "move_base_adapter_test");
  const ros::NodeHandle nh;  // keeps ROS running between the tests
  return RUN_ALL_TESTS();
}
