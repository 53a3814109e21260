// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/request_arrival.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(RequestArrival, IsThatOfTheConnectionHeaderWhereItIsEarlier) {
  CommandGate gate;
  const ArrivalNumber early = gate.arrive();
  const ArrivalNumber late = gate.arrive();
  const ros::M_string header = arrivalHeader(gate, early, ros::WallTime::now());
  EXPECT_EQ(earlierArrival(header, gate, late), early);
  EXPECT_EQ(earlierArrival(arrivalHeader(gate, late + 100, ros::WallTime::now()), gate, late), late);
}

TEST(RequestArrival, IsTheCallsOwnWithoutAHeaderOrWithABrokenOne) {
  CommandGate gate;
  const ArrivalNumber arrival = gate.arrive();
  EXPECT_EQ(earlierArrival({}, gate, arrival), arrival);
  for (const char* value : {"", "x", "x 1", "x -1 -1", "x 1 99999999999999999999999", "a b c"}) {
    EXPECT_EQ(earlierArrival({{"external_command_arrival", value}}, gate, arrival), arrival) << value;
  }
}

TEST(RequestArrival, OfAnotherProcessCountsAsStoppedWhereAStopCameInSince) {
  CommandGate gate, elsewhere;
  const ros::M_string header = arrivalHeader(elsewhere, 5, ros::WallTime::now());
  EXPECT_EQ(earlierArrival(header, gate, gate.arrive()), 1u) << "nothing was stopped";
  gate.stop(true, {});
  EXPECT_EQ(earlierArrival(header, gate, gate.arrive()), 0u);
  const ros::M_string later = arrivalHeader(elsewhere, 6, ros::WallTime::now() + ros::WallDuration(1.0));
  EXPECT_EQ(earlierArrival(later, gate, gate.arrive()), 3u);
}

}  // namespace
}  // namespace external_command
