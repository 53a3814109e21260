// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/message_size.h"

#include <geometry_msgs/PoseWithCovariance.h>
#include <gtest/gtest.h>
#include <nav_msgs/OccupancyGrid.h>
#include <nav_msgs/Path.h>
#include <nodelet/NodeletLoad.h>

#include <cstring>

#include "external_command/LaneFollow.h"
#include "external_command/RoutingResponse.h"
#include "external_command/ZoneCover.h"
#include "external_command/core/error.h"
#include "support/refusal.h"

namespace external_command {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Message>
Bytes bytesOf(const Message& message) {
  Bytes bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

template <class Message>
MessageSize sizeOf(const Bytes& bytes) {
  return sizeOfMessage<Message>(bytes.data(), bytes.size());
}

template <class Message>
std::string bytesRefusal(const Bytes& bytes) {
  return refusalOf([&] { sizeOf<Message>(bytes); });
}

ZoneCoverRequest someRequest() {
  ZoneCoverRequest request;
  request.command.header.frame_id = "map";
  request.command.zone_cover_area_id = "the northern yard";
  request.command.non_drivable_roi.resize(3);
  request.command.non_drivable_roi[1].points.resize(5);
  request.command.skip_swath = {4, 5};
  return request;
}

/// The places where a list or a text of `someRequest()` states its length.
std::vector<std::size_t> countsIn(const Bytes& bytes) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i + 4 <= bytes.size(); ++i) {
    Bytes changed = bytes;
    std::memset(&changed[i], 0xff, 4);
    if (bytesRefusal<ZoneCoverRequest>(changed).find("is said to have 4294967295 ") != std::string::npos)
      places.push_back(i);
  }
  return places;
}

TEST(MessageSize, IsThatOfTheMessage) {
  const Bytes bytes = bytesOf(someRequest());
  const MessageSize size = sizeOf<ZoneCoverRequest>(bytes);
  EXPECT_EQ(size.bytes, bytes.size());
  EXPECT_EQ(size.items, 3u + 5u + 2u);
  EXPECT_EQ(size.list.size, 5u);
  EXPECT_EQ(size.text.size, std::strlen("the northern yard"));
  const char* const definition = ros::message_traits::definition<ZoneCoverRequest>();
  EXPECT_EQ(fieldName(definition, size.list.place), "command.non_drivable_roi[1].points");
  EXPECT_EQ(fieldName(definition, size.text.place), "command.zone_cover_area_id");
}

TEST(MessageSize, OfEmptyMessagesIsFound) {
  EXPECT_EQ(sizeOf<LaneFollowRequest>(bytesOf(LaneFollowRequest())).items, 0u);
  EXPECT_EQ(sizeOf<RoutingResponse>(bytesOf(RoutingResponse())).items, 0u);
  EXPECT_EQ(sizeOf<nodelet::NodeletLoadRequest>(bytesOf(nodelet::NodeletLoadRequest())).text.size, 0u);
  EXPECT_EQ(sizeOf<geometry_msgs::PoseWithCovariance>(bytesOf(geometry_msgs::PoseWithCovariance())).items, 0u)
      << "has an array of fixed length";
}

TEST(MessageSize, CountsAListOfBytesAsOne) {
  nav_msgs::OccupancyGrid grid;
  grid.data.resize(1000000);
  EXPECT_EQ(sizeOf<nav_msgs::OccupancyGrid>(bytesOf(grid)).items, 1u);
}

TEST(MessageSize, NamesItemsOfLists) {
  nav_msgs::Path path;
  path.poses.resize(3);
  path.poses[2].header.frame_id = "somewhere";
  EXPECT_EQ(
      fieldName(ros::message_traits::definition<nav_msgs::Path>(), sizeOf<nav_msgs::Path>(bytesOf(path)).text.place),
      "poses[2].header.frame_id");
  LaneFollowRequest request;
  request.command.blacklisted_road = {"a", "bbb", "c"};
  EXPECT_EQ(fieldName(ros::message_traits::definition<LaneFollowRequest>(),
                      sizeOf<LaneFollowRequest>(bytesOf(request)).text.place),
            "command.blacklisted_road[1]");
}

TEST(MessageSize, RefusesACountThatExceedsTheBytes) {
  LaneFollowRequest request;
  Bytes bytes = bytesOf(request);
  const std::size_t at = 4 + 8 + 4 + 8 + 1 + 1;  // header, command_id, dry_run, is_start_pose_set
  const std::uint32_t count = 100000000;
  std::memcpy(&bytes[at], &count, sizeof(count));
  EXPECT_NE(bytesRefusal<LaneFollowRequest>(bytes).find("command.way_point is said to have 100000000 elements"),
            std::string::npos)
      << bytesRefusal<LaneFollowRequest>(bytes);
}

TEST(MessageSize, RefusesEveryCountThatLies) {
  const Bytes whole = bytesOf(someRequest());
  const std::vector<std::size_t> places = countsIn(whole);
  EXPECT_GE(places.size(), 9u);
  for (const std::size_t place : places) {
    for (const std::uint32_t count : {0x00ffffffu, 0x10000001u, 0x20000001u, 0x80000000u, 0xffffffffu}) {
      Bytes bytes = whole;
      std::memcpy(&bytes[place], &count, sizeof(count));
      EXPECT_NE(bytesRefusal<ZoneCoverRequest>(bytes), "") << count << " at " << place;
    }
  }
}

TEST(MessageSize, RefusesAMessageCutShortOrTooLong) {
  const Bytes whole = bytesOf(someRequest());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(bytesRefusal<ZoneCoverRequest>(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))),
              "")
        << size << " bytes";
  }
  Bytes longer = whole;
  longer.push_back(0);
  EXPECT_NE(bytesRefusal<ZoneCoverRequest>(longer).find("1 bytes behind"), std::string::npos);
}

/// roscpp must be able to read whatever is not refused.
TEST(MessageSize, RefusesAllThatCannotBeRead) {
  const Bytes whole = bytesOf(someRequest());
  std::uint32_t random = 1;
  const auto next = [&random] { return random = random * 1664525u + 1013904223u; };
  int taken = 0;
  for (int i = 0; i < 20000; ++i) {
    Bytes bytes = whole;
    for (std::uint32_t changes = 1 + (next() >> 8) % 3; changes > 0; --changes) {
      bytes[(next() >> 8) % bytes.size()] = static_cast<std::uint8_t>(next() >> 24);
    }
    if (!bytesRefusal<ZoneCoverRequest>(bytes).empty()) continue;
    ++taken;
    ZoneCoverRequest request;
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ASSERT_NO_THROW(ros::serialization::deserialize(stream, request)) << "change " << i;
    ASSERT_EQ(stream.getLength(), 0u) << "change " << i;
  }
  EXPECT_GT(taken, 1000);
}

}  // namespace
}  // namespace external_command
