// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_topics.h"

#include <nav_msgs/Path.h>

#include <utility>

#include "external_command/ros/markers.h"

namespace external_command {

MotionTopics::MotionTopics(MotionPublishers publishers, const PlanningCommand& command)
    : publishers_(std::move(publishers)),
      command_id_(command.command_id),
      frame_(command.header.frame_id),
      route_(command.has_lane_follow_command ? std::optional<RoutingResponse>(command.lane_follow_command)
                                             : std::nullopt) {}

void MotionTopics::withdraw() {
  if (is_withdrawn_) return;
  is_withdrawn_ = true;
  PlanningCommand command;
  command.header.stamp = ros::Time::now();
  command.header.frame_id = frame_;
  command.command_id = command_id_;
  for (const ros::Publisher& publisher : publishers_.commands) publisher.publish(command);
  publishers_.path.publish(toNavPath({}, frame_));
  RoutingResponse no_route;
  no_route.header = command.header;
  publishers_.routing.publish(no_route);
}

void MotionTopics::showAgain(const Path& rest) {
  if (!is_withdrawn_) return;
  is_withdrawn_ = false;
  publishers_.path.publish(toNavPath(rest, frame_));
  if (route_) publishers_.routing.publish(*route_);
}

}  // namespace external_command
