// SPDX-License-Identifier: Apache-2.0
// What a planning module in C++ does with the command of another package.
#include <external_command/PlanningCommand.h>
#include <external_command/ros/any_message.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <string>

#include "parcel_station/DeliverParcel.h"
#include "parcel_station/HatchCommand.h"

namespace parcel_station {
namespace {

namespace ec = external_command;

constexpr double kDeadline = 30.0;  // [s]

DeliverParcelCommand deliver(const std::string& parcel_id) {
  DeliverParcelCommand command;
  command.parcel_id = parcel_id;
  command.station.x = 300.0;
  command.station.y = 195.0;
  return command;
}

/// The answer to `command`, asked again until the component knows the vehicle's pose.
DeliverParcel::Response ask(const DeliverParcelCommand& command) {
  const std::string name = "parcel_station/deliver_parcel";
  DeliverParcel service;
  service.request.command = command;
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(kDeadline);
  do {
    if (!ros::service::waitForService(name, ros::Duration(kDeadline)) || !ros::service::call(name, service)) break;
  } while (service.response.status.error_code == ec::CommandStatus::NOT_READY && ros::WallTime::now() < end);
  return service.response;
}

TEST(PlanningModule, UnpacksTheCommandOfAnotherPackage) {
  const ec::CommandStatus status = ask(deliver("P-17")).status;
  ASSERT_EQ(status.status, ec::CommandStatus::RUNNING) << status.message;
  const auto command =
      ros::topic::waitForMessage<ec::PlanningCommand>("planning/command", ros::Duration(kDeadline));  // it is latched
  ASSERT_TRUE(command);
  EXPECT_EQ(command->command_id, status.command_id);
  EXPECT_TRUE(command->has_lane_follow_command);
  EXPECT_GT(command->path.points.size(), 2u);
  ASSERT_EQ(command->command_type, ec::PlanningCommand::CUSTOM);
  const auto unpacked = ec::unpackAny<DeliverParcelCommand>(command->custom_command);
  EXPECT_EQ(unpacked.parcel_id, "P-17");
  EXPECT_EQ(unpacked.command_id, status.command_id);
  EXPECT_EQ(unpacked.station.x, 300.0);
}

TEST(PlanningModule, IsToldWhenItAsksForTheWrongType) {
  const ec::Any any = ec::packAny(deliver("P-18"));
  EXPECT_THROW(ec::unpackAny<HatchCommand>(any), ec::InvalidRequest);
}

}  // namespace
}  // namespace parcel_station

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "planner_test");
  const ros::NodeHandle nh;  // keeps ROS running
  return RUN_ALL_TESTS();
}
