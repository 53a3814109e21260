// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_registry.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <vector>

#include "external_command/ros/status.h"

namespace external_command {
namespace {

constexpr std::uint64_t kDigest = 1;
const CommandOwner kLaneFollow{"lane_follow", "drive"}, kAction{"action", "act"};

class Registry : public testing::Test {
 protected:
  Registry() : registry_([this](CommandSerial, const CommandStatus& status) { told_.push_back(status); }) {
    ros::Time::init();
  }

  CommandSerial admit(std::int64_t id, const std::string& processor = "lane_follow") {
    return registry_.admit(id, {processor, "service"}, kDigest).command.serial;
  }
  bool update(CommandSerial serial, std::uint8_t status, const std::string& message = "arrived") {
    return registry_.update({serial, makeStatus(0, status, ErrorCode::kOk, message)});
  }
  bool end(CommandSerial serial) { return update(serial, CommandStatus::FINISHED); }

  CommandStatus ended(std::int64_t id) { return makeStatus(id, CommandStatus::FINISHED, ErrorCode::kOk, "arrived"); }

  std::vector<CommandStatus> told_;
  CommandRegistry registry_;
};

TEST_F(Registry, GivesFreshPositiveIds) {
  const auto first = registry_.admit(0, kLaneFollow, kDigest);
  const auto second = registry_.admit(-3, kLaneFollow, kDigest);
  EXPECT_GT(first.command.id, 0);
  EXPECT_GT(second.command.id, 0);
  EXPECT_NE(first.command.id, second.command.id);
}

TEST_F(Registry, GivesNoFreshIdThatACallerUses) {
  const auto first = registry_.admit(0, kLaneFollow, kDigest);
  registry_.admit(first.command.id + 1, kLaneFollow, kDigest);
  EXPECT_EQ(registry_.admit(0, kLaneFollow, kDigest).command.id, first.command.id + 2);
}

TEST_F(Registry, TakesTheSameCommandAgainAsARetry) {
  registry_.admit(5, kLaneFollow, kDigest);
  const auto again = registry_.admit(5, kLaneFollow, kDigest);
  ASSERT_TRUE(again.running.has_value());
  EXPECT_EQ(again.running->status, CommandStatus::RUNNING);
}

TEST_F(Registry, RefusesADifferentCommandUnderARunningId) {
  registry_.admit(5, kLaneFollow, kDigest);
  EXPECT_THROW(registry_.admit(5, kLaneFollow, kDigest + 1), DuplicateId);
  EXPECT_THROW(registry_.admit(5, CommandOwner{"speed", ""}, kDigest), DuplicateId);
}

TEST_F(Registry, LetsAnIdBeUsedAgainOnceItsCommandHasEnded) {
  const CommandSerial serial = admit(5, "lane_follow");
  end(serial);
  const auto again = registry_.admit(5, kLaneFollow, kDigest);
  EXPECT_FALSE(again.running.has_value());
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, KeepsTheRunningCommandWhenARequestUnderItsIdIsRefused) {
  registry_.admit(5, kLaneFollow, kDigest);
  registry_.refuse(makeStatus(5, CommandStatus::ERROR, ErrorCode::kInvalidRequest, "bad"), kLaneFollow);
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, RemembersARefusedRequest) {
  const auto status =
      registry_.refuse(makeStatus(0, CommandStatus::ERROR, ErrorCode::kInvalidRequest, "bad"), kLaneFollow);
  EXPECT_GT(status.command_id, 0);
  EXPECT_EQ(registry_.find(status.command_id).error_code, CommandStatus::INVALID_REQUEST);
}

TEST_F(Registry, KnowsNothingOfAnIdNeverSeen) {
  EXPECT_EQ(registry_.find(4711).status, CommandStatus::UNKNOWN);
  EXPECT_EQ(registry_.find(4711).error_code, CommandStatus::UNKNOWN_ID);
}

TEST_F(Registry, CountsOnlyTheFirstEnd) {
  const CommandSerial serial = admit(5, "lane_follow");
  EXPECT_TRUE(end(serial));
  EXPECT_FALSE(update(serial, CommandStatus::ERROR, "late"));
  EXPECT_EQ(registry_.find(5).status, CommandStatus::FINISHED);
}

TEST_F(Registry, BelievesReportsOnlyAboutCommandsThatWereSent) {
  const CommandSerial serial = admit(5, "lane_follow");
  registry_.report(ended(5), "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
  registry_.markSent(serial, "sent");
  registry_.report(ended(5), "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::FINISHED);
}

TEST_F(Registry, IgnoresReportsOlderThanTheCommandAndThoseForOthers) {
  const CommandSerial serial = admit(5, "lane_follow");
  CommandStatus old = ended(5);
  old.header.stamp -= ros::Duration(10.0);
  registry_.markSent(serial, "sent");
  registry_.report(old, "lane_follow");
  registry_.report(ended(5), "speed");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, GivesAReportedErrorACode) {
  const CommandSerial serial = admit(5, "lane_follow");
  registry_.markSent(serial, "sent");
  registry_.report(makeStatus(5, CommandStatus::ERROR, ErrorCode::kOk, "wheel lost"), "lane_follow");
  EXPECT_EQ(registry_.find(5).error_code, CommandStatus::REFUSED_BY_VEHICLE);
  EXPECT_EQ(registry_.find(5).message, "wheel lost");
}

TEST_F(Registry, NotesSilenceOnceAndForgetsItWithTheNextReport) {
  const CommandSerial serial = admit(5, "lane_follow");
  registry_.noteSilence(0.0);
  EXPECT_EQ(registry_.find(5).message.find("nothing was reported"), std::string::npos) << "not sent yet";
  registry_.markSent(serial, "sent");
  registry_.noteSilence(0.0);
  const std::size_t told = told_.size();
  registry_.noteSilence(0.0);
  EXPECT_EQ(told_.size(), told);
  EXPECT_NE(registry_.find(5).message.find("nothing was reported"), std::string::npos);
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "3 m to go"), "lane_follow");
  EXPECT_EQ(registry_.find(5).message, "3 m to go");
}

TEST_F(Registry, LetsAProcessorsOwnMessageStandUntilTheEnd) {
  const CommandSerial serial = admit(5, "zone_cover");
  registry_.markSent(serial, "sent");
  update(serial, CommandStatus::RUNNING, "swath 1 of 9");
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "3 m to go"), "zone_cover");
  EXPECT_EQ(registry_.find(5).message, "swath 1 of 9");
  registry_.report(ended(5), "zone_cover");
  EXPECT_EQ(registry_.find(5).message, "arrived");
}

TEST_F(Registry, RemembersTheNewestThousandAndNeverForgetsARunningOne) {
  registry_.admit(1, kLaneFollow, kDigest);
  for (std::int64_t id = 2; id <= 1200; ++id) {
    end(admit(id));
  }
  EXPECT_EQ(registry_.find(1).status, CommandStatus::RUNNING);
  EXPECT_EQ(registry_.find(2).status, CommandStatus::UNKNOWN);
  EXPECT_EQ(registry_.find(202).status, CommandStatus::FINISHED);
  EXPECT_EQ(registry_.find(1200).status, CommandStatus::FINISHED);
}

TEST_F(Registry, NeverForgetsARunningCommandWhateverElseRuns) {
  admit(1);
  for (std::int64_t id = 2; id <= 3000; ++id) admit(id, "action");
  EXPECT_EQ(registry_.find(1).status, CommandStatus::RUNNING);
  EXPECT_EQ(registry_.find(3000).status, CommandStatus::RUNNING);
}

TEST_F(Registry, KeepsApartTwoCommandsByTheSameId) {
  const CommandSerial first = admit(5);
  end(first);
  const CommandSerial second = admit(5);
  EXPECT_NE(first, second);
  EXPECT_FALSE(update(first, CommandStatus::ERROR, "late")) << "it has ended, and its id means another one";
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
  EXPECT_TRUE(registry_.isRunning(second));
  EXPECT_FALSE(registry_.statusOf(first).has_value());
}

TEST_F(Registry, GivesWhatAlwaysActsAFreshIdWhereItsOwnRuns) {
  admit(5);
  const auto stop = registry_.admitAlways(5, kAction);
  EXPECT_NE(stop.command.id, 5);
  EXPECT_NE(stop.note.find("command_id 5 belongs to a command of lane_follow"), std::string::npos) << stop.note;
  const auto again = registry_.admitAlways(stop.command.id, kAction);
  EXPECT_NE(again.command.id, stop.command.id) << "the same again acts again";
  EXPECT_FALSE(again.running.has_value());
}

TEST_F(Registry, GivesWhatAlwaysActsAFreshIdWhereItsOwnIsThatOfACommandThatHasEnded) {
  end(admit(5));
  const auto clear = registry_.admitAlways(5, kAction);
  EXPECT_NE(clear.command.id, 5);
  EXPECT_NE(clear.note.find("command_id 5 belongs to a command of lane_follow that has ended"), std::string::npos)
      << clear.note;
  EXPECT_TRUE(hasEnded(registry_.find(5))) << "how it ended can still be asked for";
}

TEST_F(Registry, LetsWhatAlwaysActsHaveAnIdThatNobodyUsed) {
  const auto stop = registry_.admitAlways(5, kAction);
  EXPECT_EQ(stop.command.id, 5);
  EXPECT_TRUE(stop.note.empty());
}

TEST_F(Registry, TakesNoteOfNoReportWithoutAProperStatus) {
  const CommandSerial serial = admit(5);
  registry_.markSent(serial, "sent");
  for (const std::uint8_t status : {0, 4, 5, 255}) {
    EXPECT_FALSE(registry_.report(makeStatus(5, status, ErrorCode::kOk, "odd"), "lane_follow"));
  }
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
  EXPECT_EQ(registry_.find(5).message, "sent");
}

TEST_F(Registry, BelievesAReportStampedALittleBeforeTheCommandWasSent) {
  const CommandSerial serial = admit(5);
  registry_.markSent(serial, "sent");
  CommandStatus report = ended(5);
  report.header.stamp -= ros::Duration(0.4);
  registry_.report(report, "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::FINISHED);
}

TEST_F(Registry, DoesNotTakeALateReportAboutAnEarlierCommandByTheSameIdForThisOne) {
  end(admit(5));
  registry_.markSent(admit(5), "sent");
  CommandStatus report = ended(5);
  report.header.stamp -= ros::Duration(0.1);
  registry_.report(report, "lane_follow");
  EXPECT_EQ(registry_.find(5).status, CommandStatus::RUNNING);
}

TEST_F(Registry, NotesSilenceBesideAProcessorsOwnMessage) {
  const CommandSerial serial = admit(5, "zone_cover");
  registry_.markSent(serial, "sent");
  registry_.noteSilence(0.0);
  update(serial, CommandStatus::RUNNING, "swath 1 of 9");
  EXPECT_NE(registry_.find(5).message.find("nothing was reported"), std::string::npos);
  EXPECT_NE(registry_.find(5).message.find("swath 1 of 9"), std::string::npos);
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "3 m to go"), "zone_cover");
  EXPECT_EQ(registry_.find(5).message, "swath 1 of 9");
}

TEST(RegistryByPose, LeavesTheEndToThePoseWhereReportsMayNotTellIt) {
  ros::Time::init();
  ReportRules rules;
  rules.may_finish = false;
  CommandRegistry registry({}, rules);
  registry.markSent(registry.admit(5, kLaneFollow, kDigest).command.serial, "sent");
  registry.report(makeStatus(5, CommandStatus::FINISHED, ErrorCode::kOk, "arrived"), "lane_follow");
  EXPECT_EQ(registry.find(5).status, CommandStatus::RUNNING);
  registry.report(makeStatus(5, CommandStatus::ERROR, ErrorCode::kOk, "wheel lost"), "lane_follow");
  EXPECT_EQ(registry.find(5).status, CommandStatus::ERROR);
}

TEST_F(Registry, TellsEveryChangeAndOnlyChanges) {
  const CommandSerial serial = admit(5, "lane_follow");
  registry_.markSent(serial, "sent");
  registry_.report(makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "sent"), "lane_follow");
  end(serial);
  ASSERT_EQ(told_.size(), 3u);
  EXPECT_EQ(told_[0].message, "being planned");
  EXPECT_EQ(told_[1].message, "sent");
  EXPECT_EQ(told_[2].status, CommandStatus::FINISHED);
}

TEST_F(Registry, FindsTheNewestCommandByAnId) {
  EXPECT_FALSE(registry_.serialOf(7));
  const CommandSerial first = admit(7);
  EXPECT_EQ(registry_.serialOf(7), first);
  end(first);
  const CommandSerial second = admit(7);
  EXPECT_EQ(registry_.serialOf(7), second);
}

TEST_F(Registry, TellsACommandThatWasEndedMeanwhile) {
  const AdmittedCommand command = registry_.admit(7, kAction, kDigest).command;
  EXPECT_NO_THROW(registry_.requireRunning(command));
  registry_.update({command.serial, makeStatus(7, CommandStatus::ERROR, ErrorCode::kCancelled, "cancelled")});
  EXPECT_THROW(registry_.requireRunning(command), Cancelled);
}

TEST_F(Registry, NamesTheServiceOfEveryCommand) {
  registry_.admit(1, kLaneFollow, kDigest);
  EXPECT_EQ(registry_.find(1).service, "drive");
  EXPECT_EQ(registry_.admit(1, kLaneFollow, kDigest).running->service, "drive") << "to a retry";
  EXPECT_EQ(registry_.refuse(makeStatus(2, CommandStatus::ERROR, ErrorCode::kNoRoute, "none"), kAction).service, "act");
  EXPECT_EQ(registry_.find(2).service, "act");
  EXPECT_EQ(registry_.find(3).service, "") << "it is not known";
  for (const CommandStatus& status : told_) EXPECT_NE(status.service, "");
}

TEST_F(Registry, KeepsTheProgressOfADrivenCommandThroughReports) {
  const CommandSerial serial = admit(5, "lane_follow");
  registry_.noteProgress(serial, MotionProgress{8.0, 0.2, 4.0});
  EXPECT_FALSE(registry_.find(5).has_progress) << "it is planned yet";
  registry_.markSent(serial, "sent");
  const std::size_t news = told_.size();
  registry_.noteProgress(serial, MotionProgress{8.0, 0.2, 4.0});
  EXPECT_EQ(told_.size(), news) << "progress is no news";

  CommandStatus report = makeStatus(5, CommandStatus::RUNNING, ErrorCode::kOk, "on my way");
  report.has_progress = true;
  report.share_done = 0.9;
  report.service = "planner";
  registry_.report(report, "lane_follow");
  const CommandStatus status = registry_.find(5);
  EXPECT_EQ(status.message, "on my way");
  EXPECT_EQ(status.service, "service");
  EXPECT_TRUE(status.has_progress);
  EXPECT_EQ(status.distance_left, 8.0);
  EXPECT_EQ(status.share_done, 0.2) << "what the planner says of it does not count";
  EXPECT_EQ(status.time_left, 4.0);

  registry_.noteProgress(serial, std::nullopt);
  EXPECT_FALSE(registry_.find(5).has_progress) << "the pose was lost";
  EXPECT_EQ(registry_.find(5).distance_left, 0.0);
}

TEST_F(Registry, IsDoneWithADrivenCommandThatIsFinishedOnly) {
  const CommandSerial arrived = admit(5), failed = admit(6), never_driven = admit(7);
  registry_.markSent(arrived, "sent");
  registry_.markSent(failed, "sent");
  registry_.noteProgress(failed, MotionProgress{8.0, 0.2, 4.0});
  end(arrived);
  registry_.update({failed, makeStatus(6, CommandStatus::ERROR, ErrorCode::kCancelled, "cancelled")});
  end(never_driven);
  EXPECT_TRUE(registry_.find(5).has_progress);
  EXPECT_EQ(registry_.find(5).share_done, 1.0);
  EXPECT_EQ(registry_.find(5).distance_left, 0.0);
  EXPECT_FALSE(registry_.find(6).has_progress);
  EXPECT_FALSE(registry_.find(7).has_progress);
}

TEST_F(Registry, ListsWhatRunsInTheOrderOfAdmission) {
  EXPECT_TRUE(registry_.running().empty());
  admit(9);
  const CommandSerial ended = admit(3);
  admit(4);
  end(ended);
  const std::vector<CommandStatus> running = registry_.running();
  ASSERT_EQ(running.size(), 2u);
  EXPECT_EQ(running[0].command_id, 9);
  EXPECT_EQ(running[1].command_id, 4);
}

}  // namespace
}  // namespace external_command
