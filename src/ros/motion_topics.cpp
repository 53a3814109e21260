// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_topics.h"

#include <utility>

#include "external_command/ros/motion_bytes.h"

namespace external_command {

namespace {

std_msgs::Header stampedNow(std_msgs::Header header) {
  header.stamp = ros::Time::now();
  return header;
}

}  // namespace

MotionTopics::MotionTopics(MotionPublishers publishers, PlanningCommand&& command, std::shared_ptr<const Path> path)
    : publishers_(std::move(publishers)),
      command_id_(command.command_id),
      header_(command.header),
      path_(std::move(path)),
      route_(command.has_lane_follow_command ? std::optional<RoutingResponse>(std::move(command.lane_follow_command))
                                             : std::nullopt) {}

std::vector<PreparedMessage> MotionTopics::view() const {
  std::vector<PreparedMessage> messages;
  if (route_) messages.emplace_back(publishers_.routing, *route_);
  if (path_) messages.emplace_back(publishers_.path, navPathBytesOf(*path_, header_));
  return messages;
}

void MotionTopics::withdraw() {
  if (is_withdrawn_) return;
  is_withdrawn_ = true;
  PlanningCommand command;
  command.header = stampedNow(header_);
  command.command_id = command_id_;
  for (const ros::Publisher& publisher : publishers_.commands) publisher.publish(command);
  publishers_.path.publish(navPathBytesOf({}, command.header));
  RoutingResponse no_route;
  no_route.header = command.header;
  publishers_.routing.publish(no_route);
}

void MotionTopics::showAgain(const Path& rest) {
  if (!is_withdrawn_) return;
  is_withdrawn_ = false;
  publishers_.path.publish(navPathBytesOf(rest, stampedNow(header_)));
  if (route_) publishers_.routing.publish(*route_);
}

}  // namespace external_command
