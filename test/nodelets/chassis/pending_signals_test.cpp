// SPDX-License-Identifier: Apache-2.0
#include "nodelets/chassis/pending_signals.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <string>

#include "external_command/core/error.h"

namespace external_command {
namespace {

VehicleSignal signals(std::uint8_t turn, std::uint8_t low_beam = VehicleSignal::KEEP) {
  VehicleSignal made;
  made.turn_signal = turn;
  made.low_beam = low_beam;
  return made;
}

AdmittedCommand signalled(std::int64_t id) { return {static_cast<CommandSerial>(id), id, 0}; }

class Signals : public testing::Test {
 protected:
  void SetUp() override { ros::Time::init(); }

  PendingSignals pending_{5.0};
};

TEST_F(Signals, AreFinishedWhenTheChassisReportsThemAll) {
  pending_.add(signalled(1), signals(VehicleSignal::TURN_LEFT, VehicleSignal::ON), 0.0);
  EXPECT_TRUE(pending_.onChassis(signals(VehicleSignal::TURN_LEFT, VehicleSignal::OFF)).empty());
  const auto changes = pending_.onChassis(signals(VehicleSignal::TURN_LEFT, VehicleSignal::ON));
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].status.status, CommandStatus::FINISHED);
}

TEST_F(Signals, DoNotLookAtWhatIsKept) {
  pending_.add(signalled(1), signals(VehicleSignal::TURN_KEEP, VehicleSignal::OFF), 0.0);
  EXPECT_EQ(pending_.onChassis(signals(VehicleSignal::TURN_HAZARD, VehicleSignal::OFF)).size(), 1u);
}

TEST_F(Signals, BecomeUnknownWhenTheChassisDoesNotFollow) {
  pending_.add(signalled(1), signals(VehicleSignal::TURN_LEFT), 10.0);
  pending_.onChassis(signals(VehicleSignal::TURN_NONE));
  EXPECT_TRUE(pending_.onTime(14.9).empty());
  const auto changes = pending_.onTime(15.0);
  ASSERT_EQ(changes.size(), 1u);
  EXPECT_EQ(changes[0].status.status, CommandStatus::UNKNOWN);
  EXPECT_NE(changes[0].status.message.find("turn_signal is 1, not 2"), std::string::npos) << changes[0].status.message;
}

TEST_F(Signals, AreSupersededByACommandThatContradicts) {
  pending_.add(signalled(1), signals(VehicleSignal::TURN_LEFT), 0.0);
  EXPECT_TRUE(pending_.add(signalled(2), signals(VehicleSignal::TURN_LEFT, VehicleSignal::ON), 0.0).empty());
  EXPECT_TRUE(pending_.add(signalled(3), signals(VehicleSignal::TURN_KEEP, VehicleSignal::ON), 0.0).empty());
  const auto changes = pending_.add(signalled(4), signals(VehicleSignal::TURN_RIGHT), 0.0);
  ASSERT_EQ(changes.size(), 2u);
  EXPECT_EQ(changes[0].serial, 1u);
  EXPECT_EQ(changes[1].serial, 2u);
  EXPECT_EQ(changes[1].status.error_code, CommandStatus::SUPERSEDED);
}

TEST_F(Signals, AreCheckedForTheirRanges) {
  EXPECT_NO_THROW(checkSignals(signals(VehicleSignal::TURN_HAZARD, VehicleSignal::ON)));
  EXPECT_THROW(checkSignals(signals(VehicleSignal::TURN_HAZARD + 1)), InvalidRequest);
  try {
    checkSignals(signals(VehicleSignal::TURN_LEFT, 3));
    FAIL() << "low_beam 3 was accepted";
  } catch (const InvalidRequest& error) {
    EXPECT_STREQ(error.what(), "basic_signal.low_beam is 3; it must be 0 to 2");
  }
}

TEST_F(Signals, TellWhetherThereIsAnythingToWaitFor) {
  EXPECT_FALSE(commandsAny(VehicleSignal()));
  EXPECT_TRUE(commandsAny(signals(VehicleSignal::TURN_NONE)));
}

TEST_F(Signals, AreNotWaitedForAnyMoreThatWereEndedOtherwise) {
  pending_.add(signalled(1), signals(VehicleSignal::TURN_LEFT), 0.0);
  pending_.keepWhere([](CommandSerial /*serial*/) { return false; });
  EXPECT_TRUE(pending_.onTime(1000.0).empty());
}

}  // namespace
}  // namespace external_command
