// SPDX-License-Identifier: Apache-2.0
#include "nodelets/action/pending_actions.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <cmath>
#include <limits>

#include "external_command/ActionCommand.h"
#include "external_command/ros/status.h"

namespace external_command {
namespace {

constexpr std::int64_t kMotion = 77;  // the running motion command

/// Serial, id and arrival are all the same.
AdmittedCommand command(std::int64_t id) {
  return {static_cast<CommandSerial>(id), id, static_cast<ArrivalNumber>(id)};
}

class Actions : public testing::Test {
 protected:
  void SetUp() override {
    ros::Time::init();
    motion_.command = {kMotion, kMotion, 0};
  }

  PendingActions::Changes report(std::int64_t id, std::uint8_t status, const std::string& message = "ok") {
    return pending_.onPlannerStatus(makeStatus(id, status, ErrorCode::kOk, message), &motion_);
  }
  PendingActions::Changes reportFinished(std::int64_t id) { return report(id, CommandStatus::FINISHED); }

  PendingActions::Changes chassis(double speed, const std::string& vin = "") {
    Chassis message;
    message.speed_mps = speed;
    message.vin = vin;
    return pending_.onChassis(message);
  }

  SentMotion motion_;
  PendingActions pending_{PendingActionParams()};
};

testing::AssertionResult ended(const PendingActions::Changes& changes, std::int64_t id, std::uint8_t status) {
  if (changes.size() != 1) return testing::AssertionFailure() << changes.size() << " statuses changed";
  if (changes[0].status.command_id == id && changes[0].status.status == status) return testing::AssertionSuccess();
  return testing::AssertionFailure() << "command " << changes[0].status.command_id << ", status "
                                     << static_cast<int>(changes[0].status.status) << ": " << changes[0].status.message;
}

TEST_F(Actions, NeedScenarioAndReportToFinishAStop) {
  pending_.add(command(1), ActionCommand::STOP, 0.0);
  EXPECT_TRUE(pending_.onScenario("EMERGENCY_STOP").empty());
  EXPECT_TRUE(ended(reportFinished(0), 1, CommandStatus::FINISHED));
  EXPECT_TRUE(reportFinished(0).empty()) << "it has ended";
}

TEST_F(Actions, TakeScenarioAndReportInEitherOrder) {
  pending_.add(command(1), ActionCommand::PULL_OVER, 0.0);
  EXPECT_TRUE(reportFinished(0).empty());
  EXPECT_TRUE(pending_.onScenario("EMERGENCY_STOP").empty()) << "another action's";
  EXPECT_TRUE(ended(pending_.onScenario("EMERGENCY_PULL_OVER"), 1, CommandStatus::FINISHED));
}

TEST_F(Actions, TakeReportsAboutAStopUnderItsOwnAndTheMotionCommandsId) {
  pending_.onScenario("EMERGENCY_STOP");
  for (const std::int64_t id : {std::int64_t{1}, kMotion}) {
    pending_.add(command(1), ActionCommand::STOP, 0.0);
    EXPECT_TRUE(reportFinished(2).empty()) << "somebody else's";
    EXPECT_TRUE(report(id, CommandStatus::RUNNING).empty());
    EXPECT_TRUE(ended(reportFinished(id), 1, CommandStatus::FINISHED));
  }
}

TEST_F(Actions, DoNotEndAStopWithAnErrorOfTheMotionCommand) {
  pending_.add(command(1), ActionCommand::STOP, 0.0);
  EXPECT_TRUE(report(kMotion, CommandStatus::ERROR).empty());
  EXPECT_TRUE(ended(report(1, CommandStatus::ERROR, "no brakes"), 1, CommandStatus::ERROR));
}

TEST_F(Actions, DoNotTakeTheAcknowledgementOfAnotherActionForTheEndOfAStop) {
  pending_.add(command(1), ActionCommand::CHANGE_LEFT, 0.0);
  pending_.add(command(2), ActionCommand::STOP, 0.0);
  EXPECT_TRUE(ended(reportFinished(0), 1, CommandStatus::FINISHED));
  EXPECT_TRUE(pending_.onScenario("EMERGENCY_STOP").empty()) << "it is still braking";
  EXPECT_TRUE(ended(reportFinished(0), 2, CommandStatus::FINISHED));
}

TEST_F(Actions, EndWhatThePlannerTakesNoteOfByReportOrScenario) {
  pending_.add(command(1), ActionCommand::CHANGE_LEFT, 0.0);
  EXPECT_TRUE(ended(reportFinished(1), 1, CommandStatus::FINISHED));
  pending_.add(command(2), ActionCommand::ENTER_MISSION, 0.0);
  EXPECT_TRUE(pending_.onScenario("CHANGE_LEFT").empty());
  EXPECT_TRUE(ended(pending_.onScenario("ENTER_MISSION"), 2, CommandStatus::FINISHED));
  pending_.add(command(3), ActionCommand::CHANGE_RIGHT, 0.0);
  EXPECT_TRUE(reportFinished(kMotion).empty());
  const auto changes = report(0, CommandStatus::ERROR, "no lane there");
  ASSERT_TRUE(ended(changes, 3, CommandStatus::ERROR));
  EXPECT_EQ(changes[0].status.error_code, CommandStatus::REFUSED_BY_VEHICLE);
  EXPECT_EQ(changes[0].status.message, "no lane there");
}

TEST_F(Actions, EndAStartWhenTheVehicleMoves) {
  pending_.add(command(1), ActionCommand::START, 0.0);
  EXPECT_TRUE(chassis(0.1).empty());
  EXPECT_TRUE(reportFinished(0).empty());
  EXPECT_TRUE(ended(chassis(-0.2), 1, CommandStatus::FINISHED)) << "in reverse it moves as well";
}

TEST_F(Actions, EndAStartWithAFirstReportThatShowsMovement) {
  pending_.add(command(1), ActionCommand::START, 0.0);
  EXPECT_TRUE(ended(chassis(3.0), 1, CommandStatus::FINISHED));
}

TEST_F(Actions, DoNotTakeAMovementThatBeganBeforeForThatOfAStart) {
  chassis(3.0);
  pending_.add(command(1), ActionCommand::START, 0.0);
  EXPECT_TRUE(chassis(3.0).empty());
  EXPECT_TRUE(chassis(0.0).empty());
  EXPECT_TRUE(ended(chassis(0.5), 1, CommandStatus::FINISHED));
}

TEST_F(Actions, EndAStartOfAVehicleThatStillMovesSomeSecondsLater) {
  chassis(3.0);
  pending_.add(command(1), ActionCommand::START, 10.0);
  EXPECT_TRUE(pending_.onTime(11.0).empty());
  EXPECT_TRUE(chassis(3.0).empty()) << "it may be braking for a stop";
  EXPECT_TRUE(pending_.onTime(12.5).empty());
  EXPECT_TRUE(ended(chassis(3.0), 1, CommandStatus::FINISHED));
}

TEST_F(Actions, DoNotTakeASpeedThatIsNoneForMovement) {
  chassis(0.0);
  pending_.add(command(1), ActionCommand::START, 0.0);
  EXPECT_TRUE(chassis(std::nan("")).empty());
  EXPECT_TRUE(chassis(std::numeric_limits<double>::infinity()).empty());
}

TEST_F(Actions, AreSupersededByAMotionCommandThatArrivedAfterThem) {
  pending_.add(command(3), ActionCommand::STOP, 0.0);
  pending_.add(command(4), ActionCommand::PULL_OVER, 0.0);
  EXPECT_EQ(pending_.onMotionSent(command(2)).size(), 0u) << "it arrived before them";
  EXPECT_TRUE(ended(pending_.onMotionSent(command(9)), 4, CommandStatus::ERROR));
  pending_.add(command(10), ActionCommand::CHANGE_LEFT, 0.0);
  EXPECT_TRUE(pending_.onMotionSent(command(11)).empty()) << "it stops nothing";
}

TEST_F(Actions, TakeNoReportThatIsOlderThanThem) {
  pending_.add(command(1), ActionCommand::FOLLOW, 0.0);
  CommandStatus old = makeStatus(0, CommandStatus::FINISHED, ErrorCode::kOk, "an earlier one");
  old.header.stamp -= ros::Duration(5.0);
  EXPECT_TRUE(pending_.onPlannerStatus(old, nullptr).empty());
  EXPECT_TRUE(ended(reportFinished(0), 1, CommandStatus::FINISHED));
}

TEST_F(Actions, AreBoundedInNumber) {
  for (int i = 1; i <= 1000; ++i) EXPECT_TRUE(pending_.add(command(i), ActionCommand::STOP, 0.0).empty());
  const auto changes = pending_.add(command(1001), ActionCommand::STOP, 0.0);
  ASSERT_TRUE(ended(changes, 1, CommandStatus::ERROR));
  EXPECT_EQ(changes[0].status.error_code, CommandStatus::SUPERSEDED);
}

TEST_F(Actions, EndAVinRequestWhenTheChassisTellsIt) {
  pending_.add(command(1), ActionCommand::VIN_REQ, 0.0);
  EXPECT_TRUE(chassis(3.0).empty());
  EXPECT_TRUE(report(0, CommandStatus::ERROR).empty()) << "not the planner's business";
  const auto changes = chassis(0.0, "LV123");
  ASSERT_TRUE(ended(changes, 1, CommandStatus::FINISHED));
  EXPECT_EQ(changes[0].status.message, "vin LV123");
}

TEST_F(Actions, BecomeUnknownWhenNothingShowsTheirEnd) {
  pending_.add(command(1), ActionCommand::FOLLOW, 100.0);
  pending_.add(command(2), ActionCommand::STOP, 100.0);
  EXPECT_TRUE(pending_.onTime(129.9).empty());
  EXPECT_TRUE(ended(pending_.onTime(130.0), 1, CommandStatus::UNKNOWN));
  EXPECT_TRUE(pending_.onTime(219.9).empty());
  EXPECT_TRUE(ended(pending_.onTime(220.0), 2, CommandStatus::UNKNOWN));
}

TEST_F(Actions, LetTheNewestOfStopPullOverAndStartCount) {
  EXPECT_TRUE(pending_.add(command(1), ActionCommand::STOP, 0.0).empty());
  EXPECT_TRUE(pending_.add(command(2), ActionCommand::FOLLOW, 0.0).empty());
  EXPECT_TRUE(pending_.add(command(3), ActionCommand::STOP, 0.0).empty()) << "the same again: both end together";
  const auto changes = pending_.add(command(4), ActionCommand::START, 0.0);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].status.command_id, 1);
  EXPECT_EQ(changes[1].status.command_id, 3);
  EXPECT_EQ(changes[0].status.error_code, CommandStatus::SUPERSEDED);
  EXPECT_EQ(changes[0].status.message, "superseded by command 4, START");
}

TEST(ActionNames, AreThoseOfTheMessage) {
  EXPECT_EQ(nameOfAction(ActionCommand::SWITCH_TO_AUTO), "SWITCH_TO_AUTO");
  EXPECT_EQ(nameOfAction(0), "");
  EXPECT_EQ(nameOfAction(8), "");
  EXPECT_NE(knownActions().find("PULL_OVER (4)"), std::string::npos);
}

TEST_F(Actions, AreNotWaitedForAnyMoreThatWereEndedOtherwise) {
  pending_.add(command(1), ActionCommand::CHANGE_LEFT, 0.0);
  pending_.add(command(2), ActionCommand::FOLLOW, 0.0);
  pending_.keepWhere([](CommandSerial serial) { return serial == 2; });
  EXPECT_TRUE(ended(reportFinished(0), 2, CommandStatus::FINISHED));
  EXPECT_TRUE(pending_.onTime(1000.0).empty());
}

}  // namespace
}  // namespace external_command
