// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/request_limits.h"

#include <gtest/gtest.h>

#include "external_command/ZoneCover.h"
#include "external_command/core/error.h"
#include "external_command/ros/caller_limits.h"
#include "support/refusal.h"

namespace external_command {
namespace {

const char* const kDefinition = ros::message_traits::definition<ZoneCoverRequest>();

MessageSize sizeOf(const ZoneCoverRequest& request) {
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(request);
  return sizeOfMessage<ZoneCoverRequest>(bytes.message_start, bytes.num_bytes - 4);
}

TEST(RequestLimits, TakeARequestOfTheirSize) {
  RequestLimits limits;
  limits.max_points = 6;
  limits.max_text = 3;
  ZoneCoverRequest request;
  request.command.header.frame_id = "map";
  request.command.drivable_roi.points.resize(6);
  limits.max_bytes = sizeOf(request).bytes;
  EXPECT_NO_THROW(limits.requireRequest(sizeOf(request), kDefinition));
  EXPECT_NO_THROW(limits.requireTexts(sizeOf(request), kDefinition));
}

TEST(RequestLimits, RefuseElementsInSumAndNameTheLargestList) {
  RequestLimits limits;
  limits.max_points = 10;
  ZoneCoverRequest request;
  request.command.drivable_roi.points.resize(6);
  request.command.non_drivable_roi.resize(5);
  EXPECT_EQ(refusalOf([&] { limits.requireRequest(sizeOf(request), kDefinition); }),
            "the lists have 11 elements in sum, command.drivable_roi.points has 6; the limit is 10 "
            "(~requests/max_points)");
}

TEST(RequestLimits, RefuseALongTextAndNameIt) {
  RequestLimits limits;
  ZoneCoverRequest request;
  request.command.header.frame_id = std::string(1000000, 'x');
  EXPECT_EQ(refusalOf([&] { limits.requireTexts(sizeOf(request), kDefinition); }),
            "command.header.frame_id has 1000000 bytes; the limit is 1000 (~requests/max_text)");
}

TEST(RequestLimits, RefuseALargeRequest) {
  RequestLimits limits;
  limits.max_bytes = 10;
  EXPECT_NE(refusalOf([&] { limits.requireRequest(sizeOf({}), kDefinition); }).find("(~requests/max_bytes)"),
            std::string::npos);
}

TEST(CallerLimits, LetEveryoneInWhereNobodyIsNamed) {
  EXPECT_NO_THROW(CallerLimits().require("/anybody", "speed"));
  EXPECT_NO_THROW(CallerLimits().require("", "speed"));
}

TEST(CallerLimits, LetInOnlyThoseThatAreNamed) {
  const CallerLimits limits{true, {"/dispatch", "/hmi"}};
  EXPECT_NO_THROW(limits.require("/hmi", "speed"));
  EXPECT_EQ(refusalOf([&] { limits.require("/hm\n", "speed"); }),
            "the caller /hm\\x0a is not allowed to call speed; ~allowed_callers names /dispatch, /hmi");
  EXPECT_NE(refusalOf([&] { limits.require("", "speed"); }), "");
}

TEST(CallerLimits, LetNobodyInWhereTheServiceIsOff) {
  const CallerLimits limits{false, {"/hmi"}};
  EXPECT_EQ(refusalOf([&] { limits.require("/hmi", "speed"); }), "speed is switched off (~enabled)");
}

}  // namespace
}  // namespace external_command
