// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_topics.h"

#include <algorithm>
#include <utility>

#include "external_command/ros/motion_bytes.h"

namespace external_command {

namespace {

std_msgs::Header stampedNow(std_msgs::Header header) {
  header.stamp = ros::Time::now();
  return header;
}

RoutingResponse noRoute(const std_msgs::Header& header) {
  RoutingResponse response;
  response.header = header;
  return response;
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
  if (ends_route_) messages.emplace_back(publishers_.routing, noRoute(header_));
  if (path_) messages.emplace_back(publishers_.path, navPathBytesOf(*path_, header_));
  return messages;
}

void MotionTopics::replace(const MotionTopics& earlier) {
  if (earlier.is_withdrawn_) return;
  ends_route_ = !route_ && (earlier.route_ || earlier.ends_route_);
  for (const ros::Publisher& publisher : earlier.publishers_.commands) {
    const auto isTheSame = [&](const ros::Publisher& own) { return own.getTopic() == publisher.getTopic(); };
    const auto& own = publishers_.commands;
    if (std::none_of(own.begin(), own.end(), isTheSame)) publisher.publish(earlier.withdrawal());
  }
}

void MotionTopics::withdraw() {
  if (is_withdrawn_) return;
  is_withdrawn_ = true;
  const PlanningCommand command = withdrawal();
  for (const ros::Publisher& publisher : publishers_.commands) publisher.publish(command);
  publishers_.path.publish(navPathBytesOf({}, command.header));
  publishers_.routing.publish(noRoute(command.header));
}

PlanningCommand MotionTopics::withdrawal() const {
  PlanningCommand command;
  command.header = stampedNow(header_);
  command.command_id = command_id_;
  return command;
}

void MotionTopics::showAgain(const Path& rest) {
  if (!is_withdrawn_) return;
  is_withdrawn_ = false;
  publishers_.path.publish(navPathBytesOf(rest, stampedNow(header_)));
  if (route_) publishers_.routing.publish(*route_);
}

}  // namespace external_command
