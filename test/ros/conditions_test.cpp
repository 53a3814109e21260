// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/conditions.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/ros/readiness_topic.h"

namespace external_command {
namespace {

std::string fail(const std::string& why) { throw NotReady(why); }

TEST(ConditionsOfCommands, AreNoneWhereNothingIsNeeded) { EXPECT_TRUE(Conditions().look().empty()); }

TEST(ConditionsOfCommands, TellHowEachStandsByItsName) {
  Conditions conditions;
  const auto pose = conditions.add("pose", "lane_follow", [] { return fail("the pose is not known"); });
  const auto map = conditions.add("map", "lane_follow", [] { return std::string("a town"); });
  const std::vector<Condition> found = conditions.look();
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].name, "map");
  EXPECT_TRUE(found[0].is_met);
  EXPECT_EQ(found[0].message, "a town");
  EXPECT_EQ(found[1].name, "pose");
  EXPECT_FALSE(found[1].is_met);
  EXPECT_EQ(found[1].message, "the pose is not known");
}

TEST(ConditionsOfCommands, OfOneNameAreMetWhereAllAre) {
  Conditions conditions;
  bool is_met = true;
  const auto first = conditions.add("map", "valet_parking", [] { return std::string("a town"); });
  const auto second = conditions.add("map", "lane_follow", [&] { return is_met ? "a city" : fail("no map"); });
  EXPECT_EQ(conditions.look().at(0).needed_by, (std::vector<std::string>{"lane_follow", "valet_parking"}));
  EXPECT_TRUE(conditions.look().at(0).is_met);
  is_met = false;
  EXPECT_FALSE(conditions.look().at(0).is_met);
  EXPECT_EQ(conditions.look().at(0).message, "no map");
}

TEST(ConditionsOfCommands, GoWithWhoNeedsThem) {
  Conditions conditions;
  {
    const auto chassis = conditions.add("chassis", "action", [] { return fail("nothing is heard"); });
    EXPECT_EQ(conditions.look().size(), 1u);
  }
  EXPECT_TRUE(conditions.look().empty());
}

TEST(ConditionsOfCommands, MayComeAndGoWhileTheyAreLookedAt) {
  Conditions conditions;
  bool is_over = false;
  std::mutex mutex;
  const auto isOver = [&] {
    const std::lock_guard<std::mutex> lock(mutex);
    return is_over;
  };
  std::thread looker([&] {
    while (!isOver()) conditions.look();
  });
  for (int i = 0; i < 1000; ++i) {
    auto used = std::make_unique<std::string>("what the check uses");
    auto entry = std::make_unique<Conditions::Entry>(conditions.add("map", "s", [&used] { return *used; }));
    entry.reset();
    used.reset();
  }
  {
    const std::lock_guard<std::mutex> lock(mutex);
    is_over = true;
  }
  looker.join();
  EXPECT_TRUE(conditions.look().empty());
}

class ReadinessMessage : public testing::Test {
 protected:
  ReadinessMessage() { ros::Time::init(); }
};

TEST_F(ReadinessMessage, IsReadyWhereEveryConditionIsMet) {
  EXPECT_TRUE(toMsg({{"map", true, "a town", {}}, {"pose", true, "known", {}}}).is_ready);
  const Readiness lacking = toMsg({{"map", true, "a town", {}}, {"pose", false, "not known", {"lane_follow"}}});
  EXPECT_FALSE(lacking.is_ready);
  EXPECT_EQ(lacking.conditions.at(1).message, "not known");
  EXPECT_EQ(lacking.conditions.at(1).needed_by.at(0), "lane_follow");
}

TEST_F(ReadinessMessage, SaysTheSameWhateverNumbersAreInIt) {
  const auto lacking = [](const std::string& why) { return toMsg({{"pose", false, why, {}}}); };
  EXPECT_TRUE(sayTheSame(lacking("it is 1.5 s old"), lacking("it is 20 s old")));
  EXPECT_FALSE(sayTheSame(lacking("it is 1.5 s old"), lacking("it is not known")));
  EXPECT_FALSE(sayTheSame(lacking("known"), toMsg({{"pose", true, "known", {}}})));
  EXPECT_FALSE(sayTheSame(lacking("known"), toMsg({})));
}

}  // namespace
}  // namespace external_command
