// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_gate.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

class Gate : public testing::Test {
 protected:
  std::function<void()> publishing() {
    return [this] { ++published_; };
  }

  CommandGate gate_;
  int published_ = 0;
};

TEST_F(Gate, SendsACommandThatNothingStopped) {
  const auto ticket = gate_.begin(7, gate_.arrive());
  EXPECT_FALSE(gate_.commit(ticket, publishing()).has_value());
  EXPECT_EQ(published_, 1);
  EXPECT_EQ(gate_.lastSent(), 7);
}

TEST_F(Gate, TellsWhichCommandIsReplaced) {
  gate_.commit(gate_.begin(7, gate_.arrive()), publishing());
  EXPECT_EQ(gate_.commit(gate_.begin(8, gate_.arrive()), publishing()), 7);
}

TEST_F(Gate, DoesNotSendAPlanThatEndsAfterAStop) {
  const auto ticket = gate_.begin(7, gate_.arrive());
  gate_.stop({});
  EXPECT_TRUE(ticket.cancelToken().isCancelled());
  EXPECT_THROW(gate_.commit(ticket, publishing()), Cancelled);
  EXPECT_EQ(published_, 0);
}

TEST_F(Gate, DoesNotBeginARequestThatArrivedBeforeAStop) {
  const auto arrival = gate_.arrive();
  gate_.stop({});
  EXPECT_THROW(gate_.begin(7, arrival), Cancelled);
}

TEST_F(Gate, BeginsARequestThatArrivedAfterAStop) {
  gate_.stop({});
  EXPECT_NO_THROW(gate_.commit(gate_.begin(7, gate_.arrive()), publishing()));
  EXPECT_EQ(published_, 1);
}

TEST_F(Gate, CancelsAnOlderPlanningWhenANewerBegins) {
  const auto older = gate_.begin(7, gate_.arrive());
  const auto newer = gate_.begin(8, gate_.arrive());
  EXPECT_TRUE(older.cancelToken().isCancelled());
  EXPECT_FALSE(newer.cancelToken().isCancelled());
  EXPECT_THROW(gate_.commit(older, publishing()), Superseded);
  EXPECT_NO_THROW(gate_.commit(newer, publishing()));
  EXPECT_EQ(published_, 1);
}

TEST_F(Gate, TellsWhoCancelled) {
  const auto older = gate_.begin(7, gate_.arrive());
  const auto newer = gate_.begin(8, gate_.arrive());
  EXPECT_THROW(gate_.requireCurrent(older), Superseded);
  EXPECT_NO_THROW(gate_.requireCurrent(newer));
  gate_.stop({});
  EXPECT_THROW(gate_.requireCurrent(newer), Cancelled);
}

TEST_F(Gate, TellsWhichCommandAStopFindsRunning) {
  EXPECT_FALSE(gate_.stop({}).has_value());
  gate_.commit(gate_.begin(7, gate_.arrive()), publishing());
  EXPECT_EQ(gate_.stop({}), 7);
}

TEST_F(Gate, PublishesTheStopItself) {
  gate_.stop(publishing());
  EXPECT_EQ(published_, 1);
}

}  // namespace
}  // namespace external_command
