// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/status.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <cmath>
#include <functional>
#include <stdexcept>
#include <vector>

#include "external_command/ros/checks.h"
#include "support/refusal.h"

namespace external_command {
namespace {

TEST(Status, HasTheSameNumbersAsTheErrorCodes) {
  EXPECT_EQ(static_cast<int>(ErrorCode::kOk), CommandStatus::OK);
  EXPECT_EQ(static_cast<int>(ErrorCode::kInvalidRequest), CommandStatus::INVALID_REQUEST);
  EXPECT_EQ(static_cast<int>(ErrorCode::kStaleRequest), CommandStatus::STALE_REQUEST);
  EXPECT_EQ(static_cast<int>(ErrorCode::kDuplicateId), CommandStatus::DUPLICATE_ID);
  EXPECT_EQ(static_cast<int>(ErrorCode::kUnknownId), CommandStatus::UNKNOWN_ID);
  EXPECT_EQ(static_cast<int>(ErrorCode::kNotReady), CommandStatus::NOT_READY);
  EXPECT_EQ(static_cast<int>(ErrorCode::kOffMap), CommandStatus::OFF_MAP);
  EXPECT_EQ(static_cast<int>(ErrorCode::kNoRoute), CommandStatus::NO_ROUTE);
  EXPECT_EQ(static_cast<int>(ErrorCode::kStartBlocked), CommandStatus::START_BLOCKED);
  EXPECT_EQ(static_cast<int>(ErrorCode::kGoalBlocked), CommandStatus::GOAL_BLOCKED);
  EXPECT_EQ(static_cast<int>(ErrorCode::kNoPath), CommandStatus::NO_PATH);
  EXPECT_EQ(static_cast<int>(ErrorCode::kPlanningTimeout), CommandStatus::PLANNING_TIMEOUT);
  EXPECT_EQ(static_cast<int>(ErrorCode::kCancelled), CommandStatus::CANCELLED);
  EXPECT_EQ(static_cast<int>(ErrorCode::kSuperseded), CommandStatus::SUPERSEDED);
  EXPECT_EQ(static_cast<int>(ErrorCode::kRefusedByVehicle), CommandStatus::REFUSED_BY_VEHICLE);
  EXPECT_EQ(static_cast<int>(ErrorCode::kInternalError), CommandStatus::INTERNAL_ERROR);
}

CommandStatus statusOfThrown(const std::function<void()>& thrower) {
  ros::Time::init();
  try {
    thrower();
  } catch (...) {
    return statusFrom(std::current_exception(), 3);
  }
  return {};
}

TEST(Status, KeepsCodeAndTextOfAnError) {
  const auto status = statusOfThrown([] { throw NoRoute("no way"); });
  EXPECT_EQ(status.command_id, 3);
  EXPECT_EQ(status.status, CommandStatus::ERROR);
  EXPECT_EQ(status.error_code, CommandStatus::NO_ROUTE);
  EXPECT_EQ(status.message, "no way");
}

TEST(Status, MakesAnyOtherExceptionAnInternalError) {
  EXPECT_EQ(statusOfThrown([] { throw std::out_of_range("vector"); }).error_code, CommandStatus::INTERNAL_ERROR);
  EXPECT_EQ(statusOfThrown([] { throw 5; }).error_code, CommandStatus::INTERNAL_ERROR);
}

CommandStatus reported(std::uint8_t status, std::uint16_t error_code, const std::string& message) {
  ros::Time::init();
  CommandStatus report;
  report.header.frame_id = "anything";
  report.command_id = 3;
  report.status = status;
  report.error_code = error_code;
  report.message = message;
  return report;
}

TEST(EndFromReport, KeepsCodeAndMessageOfAnError) {
  const auto end = endFromReport(5, reported(CommandStatus::ERROR, CommandStatus::NO_PATH, "a wall"));
  EXPECT_EQ(end.command_id, 5);
  EXPECT_EQ(end.status, CommandStatus::ERROR);
  EXPECT_EQ(end.error_code, CommandStatus::NO_PATH);
  EXPECT_EQ(end.message, "a wall");
}

TEST(EndFromReport, MakesNoCodeAndCodesOfThePlannersOwnOneThatProgramsKnow) {
  for (const std::uint16_t code : {0, CommandStatus::INTERNAL_ERROR + 1, 65535}) {
    const auto end = endFromReport(3, reported(CommandStatus::ERROR, code, "a wall"));
    EXPECT_EQ(end.error_code, CommandStatus::REFUSED_BY_VEHICLE) << code;
    EXPECT_NE(end.message.find("a wall"), std::string::npos) << end.message;
    EXPECT_EQ(end.message.find(std::to_string(code)) != std::string::npos, code != 0) << end.message;
  }
  EXPECT_EQ(endFromReport(3, reported(CommandStatus::ERROR, 77, "")).message, "the planner's error_code is 77");
}

TEST(EndFromReport, HasNoErrorWhereTheCommandIsFinished) {
  EXPECT_EQ(endFromReport(3, reported(CommandStatus::FINISHED, CommandStatus::NO_PATH, "")).error_code,
            CommandStatus::OK);
}

TEST(EndFromReport, PassesOnWhatIsFitToBeShownAndItsOwnStamp) {
  const auto end = endFromReport(3, reported(CommandStatus::ERROR, 0, "\x1b[2J\xff" + std::string(100000, 'x')));
  EXPECT_LT(end.message.size(), 3000U);
  EXPECT_EQ(end.message.rfind("\\x1b[2J\\xff", 0), 0U) << end.message;
  EXPECT_EQ(end.header.frame_id, "");
  EXPECT_FALSE(end.header.stamp.isZero());
}

TEST(Checks, AcceptWhatIsInRange) {
  EXPECT_NO_THROW(requireFinite(1.0, "x"));
  EXPECT_NO_THROW(requireNotNegative(0.0, "target_speed"));
  EXPECT_NO_THROW(requireWithin(0.5, 0.0, 1.0, "target_speed_factor"));
  EXPECT_NO_THROW(checkWayPoints({}, false, {}));
}

TEST(Checks, NameFieldValueAndExpectation) {
  EXPECT_EQ(refusalOf([] { requireNotNegative(-2.0, "target_speed"); }), "target_speed is -2; it must not be negative");
  EXPECT_EQ(refusalOf([] { requireWithin(1.5, 0.0, 1.0, "target_speed_factor"); }),
            "target_speed_factor is 1.5; it must lie in [0, 1]");
  EXPECT_NE(refusalOf([] { requireWithin(std::nan(""), 0.0, 1.0, "factor"); }), "");
  Pose pose;
  pose.y = std::nan("");
  EXPECT_EQ(refusalOf([&] { checkWayPoints({Pose(), pose}, false, {}); }), "way_point[1].y is nan; it must be finite");
  EXPECT_NE(refusalOf([] { checkWayPoints({}, true, {}); }).find("is_start_pose_set"), std::string::npos);
  EXPECT_NE(refusalOf([] { checkWayPoints(std::vector<Pose>(1001), false, {}); }).find("1001"), std::string::npos);
}

TEST(Checks, RefuseStampsFarFromNow) {
  ros::Time::init();
  EXPECT_NO_THROW(requireFresh(ros::Time(), 2.0)) << "not given";
  EXPECT_NO_THROW(requireFresh(ros::Time::now() - ros::Duration(1.0), 2.0));
  EXPECT_NO_THROW(requireFresh(ros::Time::now() + ros::Duration(1.0), 2.0));
  EXPECT_THROW(requireFresh(ros::Time::now() - ros::Duration(3.0), 2.0), StaleRequest);
  EXPECT_THROW(requireFresh(ros::Time::now() + ros::Duration(3.0), 2.0), StaleRequest);
}

TEST(Checks, DoNotLookAtAHeadingThatIsNotGiven) {
  Pose pose;
  pose.heading = std::nan("");
  EXPECT_NO_THROW(requireFinite(pose, "end_pose"));
  pose.has_heading = true;
  EXPECT_THROW(requireFinite(pose, "end_pose"), InvalidRequest);
}

TEST(ReportAge, IsComparedWithWhenTheCommandWasSentButForTheSkewOfClocks) {
  ros::Time::init();
  const ros::Time sent = ros::Time::now() - ros::Duration(1.0);
  EXPECT_FALSE(isOlder(sent + ros::Duration(0.1), sent, 0.5));
  EXPECT_FALSE(isOlder(sent - ros::Duration(0.4), sent, 0.5));
  EXPECT_TRUE(isOlder(sent - ros::Duration(0.6), sent, 0.5));
  EXPECT_FALSE(isOlder(ros::Time(), sent, 0.5)) << "no stamp";
}

TEST(ReportAge, DoesNotCountWhereSimulatedTimeWasSetBack) {
  ros::Time::setNow(ros::Time(100.0));
  const ros::Time sent(5000.0);
  EXPECT_FALSE(isOlder(ros::Time(99.0), sent, 0.5));
  ros::Time::setNow(ros::Time(5001.0));
  EXPECT_TRUE(isOlder(ros::Time(99.0), sent, 0.5));
  ros::Time::init();  // back to the time of the system
}

}  // namespace
}  // namespace external_command
