// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/goal_subscription.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <cstring>
#include <optional>
#include <vector>

#include "external_command/PathFollowActionGoal.h"
#include "external_command/core/error.h"
#include "external_command/ros/goal_arrival.h"
#include "external_command/ros/status.h"

namespace external_command {
namespace {

using Goal = PathFollowActionGoal;
using Bytes = std::vector<std::uint8_t>;

Goal example() {
  Goal goal;
  goal.header.frame_id = "map";
  goal.goal_id.id = "a goal";
  goal.goal.command.way_point.resize(3);
  goal.goal.command.target_speed = 5.0;
  return goal;
}

Bytes bytesOf(const Goal& goal) {
  Bytes bytes(ros::serialization::serializationLength(goal));
  ros::serialization::OStream stream(bytes.data(), bytes.size());
  ros::serialization::serialize(stream, goal);
  return bytes;
}

class GoalSubscription : public testing::Test {
 protected:
  GoalSubscription() { ros::Time::init(); }

  /// What arrives of the bytes; nullopt where they are dropped.
  std::optional<ArrivedGoal<Goal>> take(Bytes bytes) {
    std::optional<ArrivedGoal<Goal>> taken;
    GoalSubscriptionHelper<Goal> helper(
        [&](const ArrivedGoal<Goal>& goal, const std::string& caller) {
          taken = goal;
          EXPECT_EQ(caller, "/somebody");
        },
        "goals", limits_);
    const auto header = boost::make_shared<ros::M_string>(ros::M_string{{"callerid", "/somebody"}});
    ros::SubscriptionCallbackHelperDeserializeParams params;
    params.buffer = bytes.data();
    params.length = static_cast<std::uint32_t>(bytes.size());
    params.connection_header = header;
    const ros::VoidConstPtr message = helper.deserialize(params);
    EXPECT_TRUE(message);  // roscpp would try once more, with bytes that it has freed
    ros::SubscriptionCallbackHelperCallParams call;
    call.event = ros::MessageEvent<void const>(message, header, ros::Time(1.0), false,
                                               ros::MessageEvent<void const>::CreateFunction());
    helper.call(call);
    return taken;
  }

  static std::string whyNot(const ArrivedGoal<Goal>& goal) { return statusFrom(goal.fault, 0).message; }

  RequestLimits limits_;
};

TEST_F(GoalSubscription, BuildsWhatIsWhole) {
  const auto taken = take(bytesOf(example()));
  ASSERT_TRUE(taken);
  EXPECT_FALSE(taken->fault);
  EXPECT_EQ(taken->goal->goal_id.id, "a goal");
  EXPECT_EQ(taken->goal->goal.command.way_point.size(), 3U);
}

TEST_F(GoalSubscription, NeverBuildsWhatIsCutOffAndTellsOfWhatHasAnId) {
  const Bytes whole = bytesOf(example());
  const std::size_t end_of_id = 4 + 8 + 4 + 3 + 8 + 4 + 6;  // header, stamp, id
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const auto taken = take(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size)));
    ASSERT_EQ(taken.has_value(), size >= end_of_id) << size;
    if (!taken) continue;
    EXPECT_TRUE(taken->fault) << size;
    EXPECT_EQ(taken->goal->goal_id.id, "a goal");
    EXPECT_TRUE(taken->goal->goal.command.way_point.empty());
  }
}

TEST_F(GoalSubscription, BuildsNothingFromCountsThatLie) {
  const Bytes whole = bytesOf(example());
  std::size_t refused = 0;
  for (std::size_t at = 0; at + 4 <= whole.size(); ++at) {
    Bytes lying = whole;
    const std::uint32_t count = 2000000000;
    std::memcpy(lying.data() + at, &count, sizeof(count));
    const auto taken = take(lying);
    if (taken && taken->fault) ++refused;
  }
  EXPECT_GT(refused, 3U);
}

TEST_F(GoalSubscription, RefusesWhatIsTooLargeWithTheNameOfTheField) {
  limits_.max_points = 2;
  const auto many = take(bytesOf(example()));
  ASSERT_TRUE(many && many->fault);
  EXPECT_NE(whyNot(*many).find("goal.command.way_point has 3"), std::string::npos) << whyNot(*many);
  Goal wordy = example();
  wordy.goal.command.way_point.clear();
  wordy.goal.command.header.frame_id = std::string(2000, 'x');
  const auto long_text = take(bytesOf(wordy));
  ASSERT_TRUE(long_text && long_text->fault);
  EXPECT_NE(whyNot(*long_text).find("goal.command.header.frame_id has 2000 bytes"), std::string::npos)
      << whyNot(*long_text);
}

TEST_F(GoalSubscription, DropsWhatHasALongId) {
  Goal goal = example();
  goal.goal_id.id = std::string(2000, 'x');
  EXPECT_FALSE(take(bytesOf(goal)));
}

TEST(ArrivalPace, LetsAFewThroughAtOnceAndAHundredASecond) {
  using Clock = std::chrono::steady_clock;
  ArrivalPace pace;
  const auto begin = Clock::now();
  for (int i = 0; i < 15; ++i) pace.pauseIfFlooded();
  const auto burst = Clock::now() - begin;
  for (int i = 0; i < 55; ++i) pace.pauseIfFlooded();
  const std::chrono::duration<double> all = Clock::now() - begin;
  EXPECT_LT(burst, std::chrono::seconds(1));
  EXPECT_GE(all.count(), 0.45);
}

}  // namespace
}  // namespace external_command
