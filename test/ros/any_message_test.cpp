// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/any_message.h"

#include <gtest/gtest.h>

#include "external_command/LaneFollowCommand.h"
#include "external_command/SpeedCommand.h"

namespace external_command {
namespace {

LaneFollowCommand someCommand() {
  LaneFollowCommand command;
  command.command_id = 42;
  command.blacklisted_road = {"north", "south"};
  command.end_pose.x = 1.5;
  return command;
}

TEST(AnyMessage, UnpacksWhatWasPacked) {
  const Any any = packAny(someCommand());
  EXPECT_EQ(any.type, "external_command/LaneFollowCommand");
  const auto command = unpackAny<LaneFollowCommand>(any);
  EXPECT_EQ(command.command_id, 42);
  EXPECT_EQ(command.blacklisted_road, someCommand().blacklisted_road);
  EXPECT_EQ(command.end_pose.x, 1.5);
}

TEST(AnyMessage, RefusesAnotherType) { EXPECT_THROW(unpackAny<SpeedCommand>(packAny(someCommand())), InvalidRequest); }

TEST(AnyMessage, RefusesAnotherVersionOfTheType) {
  Any any = packAny(someCommand());
  any.md5sum = "0123456789abcdef0123456789abcdef";
  EXPECT_THROW(unpackAny<LaneFollowCommand>(any), InvalidRequest);
}

TEST(AnyMessage, RefusesDamagedData) {
  const Any whole = packAny(someCommand());
  for (std::size_t size = 0; size < whole.data.size(); ++size) {
    Any cut = whole;
    cut.data.resize(size);
    EXPECT_THROW(unpackAny<LaneFollowCommand>(cut), InvalidRequest) << size << " bytes";
  }
  Any longer = whole;
  longer.data.push_back(0);
  EXPECT_THROW(unpackAny<LaneFollowCommand>(longer), InvalidRequest);
}

}  // namespace
}  // namespace external_command
