// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_registry.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <vector>

#include "external_command/ros/status.h"

namespace external_command {
namespace {

constexpr std::uint64_t kDigest = 1;

class Registry : public testing::Test {
 protected:
  Registry() : registry_([this](const CommandStatus& status) { told_.push_back(status); }) { ros::Time::init(); }

  CommandStatus ended(std::int64_t id) { return makeStatus(id, CommandStatus::FINISHED, ErrorCode::kOk, "arrived"); }

  std::vector<CommandStatus> told_;
  CommandRegistry registry_;
};

TEST_F(Registry, GivesFreshPositiveIds) {
  const auto first = registry_.admit(0, "lane_follow", kDigest);
  const auto second = registry_.admit(-3, "lane_follow", kDigest);
  EXPECT_GT(first.command_id, 0);
  EXPECT_GT(second.command_id, 0);
  EXPECT_NE(first.command_id, second.command_id);
}

TEST_F(Registry, GivesNoFreshIdThatACallerUses) {
  const auto first = registry_.admit(0, "lane_follow", kDigest);
  registry_.admit(first.command_id + 1, "lane_follow", kDigest);
  EXPECT_EQ(registry_.admit(0, "lane_follow", kDigest).command_id, first.command_id + 2);
}

TEST_F(Registry, TakesTheSameCommandAgainAsARetry) {
  registry_.admit(5, "lane_follow", kDigest);
  const auto again = registry_.admit(5, "lane_follow", kDigest);
  ASSERT_TRUE(again.running.has_value());
  EXPECT_EQ(again.running->status, CommandStatus::RUNNING);
}

TEST_F(Registry, RefusesADifferentCommandUnderARunningId) {
  registry_.admit(5, "lane_follow", kDigest);
  EXPECT_THROW(registry_.admit(5, "lane_follow", kDigest + 1), DuplicateId);
  EXPECT_THROW(registry_.admit(5, "speed", kDigest), DuplicateId);
}

TEST_F(Registry, LetsAnIdBeUsedAgainOnceItsCommandHasEnded) {
  registry_.admit(5, "lane_follow", kDigest);
  registry_.update(ended(5));
  const auto again = registry_.admit(5, "lane_follow", kDigest);
  EXPECT_FALSE(again.running.has_value());
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, KeepsTheRunningCommandWhenARequestUnderItsIdIsRefused) {
  registry_.admit(5, "lane_follow", kDigest);
  registry_.refuse(makeStatus(5, CommandStatus::ERROR, ErrorCode::kInvalidRequest, "bad"), "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, RemembersARefusedRequest) {
  const auto status =
      registry_.refuse(makeStatus(0, CommandStatus::ERROR, ErrorCode::kInvalidRequest, "bad"), "lane_follow");
  EXPECT_GT(status.command_id, 0);
  EXPECT_EQ(registry_.find(status.command_id).error_code, CommandStatus::INVALID_REQUEST);
}

TEST_F(Registry, KnowsNothingOfAnIdNeverSeen) {
  EXPECT_EQ(registry_.find(4711).status, CommandStatus::UNKNOWN);
  EXPECT_EQ(registry_.find(4711).error_code, CommandStatus::UNKNOWN_ID);
}

TEST_F(Registry, CountsOnlyTheFirstEnd) {
  registry_.admit(5, "lane_follow", kDigest);
  EXPECT_TRUE(registry_.update(ended(5)));
  EXPECT_FALSE(registry_.update(makeStatus(5, CommandStatus::ERROR, ErrorCode::kSuperseded, "late")));
  EXPECT_EQ(registry_.find(5).status, CommandStatus::FINISHED);
}

TEST_F(Registry, BelievesReportsOnlyAboutCommandsThatWereSent) {
  registry_.admit(5, "lane_follow", kDigest);
  registry_.report(ended(5), "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
  registry_.markSent(5, "sent");
  registry_.report(ended(5), "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::FINISHED);
}

TEST_F(Registry, IgnoresReportsOlderThanTheCommandAndThoseForOthers) {
  registry_.admit(5, "lane_follow", kDigest);
  CommandStatus old = ended(5);
  old.header.stamp -= ros::Duration(10.0);
  registry_.markSent(5, "sent");
  registry_.report(old, "lane_follow");
  registry_.report(ended(5), "speed");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, GivesAReportedErrorACode) {
  registry_.admit(5, "lane_follow", kDigest);
  registry_.markSent(5, "sent");
  registry_.report(makeStatus(5, CommandStatus::ERROR, ErrorCode::kOk, "wheel lost"), "lane_follow");
  EXPECT_EQ(registry_.find(5).error_code, CommandStatus::REFUSED_BY_VEHICLE);
  EXPECT_EQ(registry_.find(5).message, "wheel lost");
}

TEST_F(Registry, NotesSilenceOnceAndForgetsItWithTheNextReport) {
  registry_.admit(5, "lane_follow", kDigest);
  registry_.noteSilence(0.0);
  EXPECT_EQ(registry_.find(5).message.find("nothing was reported"), std::string::npos) << "not sent yet";
  registry_.markSent(5, "sent");
  registry_.noteSilence(0.0);
  const std::size_t told = told_.size();
  registry_.noteSilence(0.0);
  EXPECT_EQ(told_.size(), told);
  EXPECT_NE(registry_.find(5).message.find("nothing was reported"), std::string::npos);
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "3 m to go"), "lane_follow");
  EXPECT_EQ(registry_.find(5).message, "3 m to go");
}

TEST_F(Registry, LetsAProcessorsOwnMessageStandUntilTheEnd) {
  registry_.admit(5, "zone_cover", kDigest);
  registry_.markSent(5, "sent");
  registry_.update(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "swath 1 of 9"));
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "3 m to go"), "zone_cover");
  EXPECT_EQ(registry_.find(5).message, "swath 1 of 9");
  registry_.report(ended(5), "zone_cover");
  EXPECT_EQ(registry_.find(5).message, "arrived");
}

TEST_F(Registry, RemembersTheNewestThousandAndNeverForgetsARunningOne) {
  registry_.admit(1, "lane_follow", kDigest);
  for (std::int64_t id = 2; id <= 1200; ++id) {
    registry_.admit(id, "lane_follow", kDigest);
    registry_.update(ended(id));
  }
  EXPECT_EQ(registry_.find(1).status, CommandStatus::RUNNING);
  EXPECT_EQ(registry_.find(2).status, CommandStatus::UNKNOWN);
  EXPECT_EQ(registry_.find(202).status, CommandStatus::FINISHED);
  EXPECT_EQ(registry_.find(1200).status, CommandStatus::FINISHED);
}

TEST_F(Registry, TellsEveryChangeAndOnlyChanges) {
  registry_.admit(5, "lane_follow", kDigest);
  registry_.markSent(5, "sent");
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "sent"), "lane_follow");
  registry_.update(ended(5));
  ASSERT_EQ(told_.size(), 3u);
  EXPECT_EQ(told_[0].message, "being planned");
  EXPECT_EQ(told_[1].message, "sent");
  EXPECT_EQ(told_[2].status, CommandStatus::FINISHED);
}

}  // namespace
}  // namespace external_command
