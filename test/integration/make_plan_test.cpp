// SPDX-License-Identifier: Apache-2.0
// Of the plans that programs for move_base ask for few wait, and none holds up the unloading of what makes them.
#include <gtest/gtest.h>
#include <nav_msgs/GetPlan.h>
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <chrono>
#include <future>
#include <pluginlib/class_loader.hpp>
#include <string>
#include <vector>

#include "support/blocking_nodelets.h"

namespace external_command {
namespace {

constexpr const char* kService = "move_base/make_plan";
constexpr const char* kAdapter = "move_base_adapter";
constexpr unsigned kMostInLine = 5;  // one in work, four that wait
constexpr std::chrono::seconds kLongest(10);

/// The adapter, and a lane follow that plans until the test lets it go on.
class MakePlan : public testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(load("lane_follow", "test/BlockingLaneFollow"));
    ASSERT_TRUE(load(kAdapter, "external_command/MoveBaseAdapter"));
    ASSERT_TRUE(ros::service::waitForService(kService, 10000));
    gate_ = lane_follow_->holdPlans(true);
  }

  void TearDown() override {
    gate_->open();
    loader_.clear();
  }

  bool load(const std::string& name, const std::string& type) {
    return loader_.load(ros::names::resolve(name), type, {}, {});
  }

  boost::shared_ptr<nodelet::Nodelet> create(const std::string& type) {
    if (type == "test/BlockingLaneFollow") return lane_follow_ = boost::make_shared<BlockingLaneFollow>();
    return classes_.createInstance(type);
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

  pluginlib::ClassLoader<nodelet::Nodelet> classes_{"nodelet", "nodelet::Nodelet"};
  boost::shared_ptr<BlockingLaneFollow> lane_follow_;
  std::shared_ptr<TestGate> gate_;
  nodelet::Loader loader_{boost::function<boost::shared_ptr<nodelet::Nodelet>(const std::string&)>(
      [this](const std::string& type) { return create(type); })};
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
  auto unloaded = std::async(std::launch::async, [this] { return loader_.unload(ros::names::resolve(kAdapter)); });
  EXPECT_EQ(unloaded.wait_for(std::chrono::seconds(1)), std::future_status::ready)
      << "though nobody opened the gate of the plan in work";
  EXPECT_EQ(gate_->entered(), 1u) << "those that wait are not planned any more";
  gate_->open();
  EXPECT_TRUE(unloaded.get());
  for (auto& answer : asked) EXPECT_EQ(answer.get(), 0u);
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "make_plan_test");
  const ros::NodeHandle nh;  // keeps ROS running between the tests
  return RUN_ALL_TESTS();
}
