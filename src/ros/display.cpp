// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/display.h"

#include <ros/single_subscriber_publisher.h>

#include <utility>

namespace external_command {

Display::Display(ros::NodeHandle nh, const DisplayParams& params, std::shared_ptr<const HdMap> map)
    : params_(params), map_(std::move(map)) {
  path_publisher_ = nh.advertise<nav_msgs::Path>(params_.path_topic, 1, true);
  nh.setCallbackQueue(lane_.queue());
  const ros::SubscriberStatusCallback greet_new = [this](const ros::SingleSubscriberPublisher& s) { greet(s); };
  markers_publisher_ = nh.advertise<visualization_msgs::MarkerArray>(
      params_.markers_topic, 10, greet_new, ros::SubscriberStatusCallback(), ros::VoidConstPtr(), true);
}

void Display::greet(const ros::SingleSubscriberPublisher& subscriber) const {
  visualization_msgs::MarkerArray array;
  if (map_) array = mapMarkers(*map_, params_.map_frame);
  array.markers.push_back(vehicleMarker(params_.vehicle, params_.base_frame));
  subscriber.publish(array);
}

void Display::show(CommandScene scene) {
  lane_.post([this, scene = std::move(scene)] {
    path_publisher_.publish(toNavPath(scene.path, params_.map_frame));
    markers_publisher_.publish(commandMarkers(scene, map_.get(), params_.vehicle, params_.map_frame));
  });
}

void Display::showRefused(CommandScene scene) {
  lane_.post([this, scene = std::move(scene)] {
    markers_publisher_.publish(commandMarkers(scene, map_.get(), params_.vehicle, params_.map_frame));
  });
}

}  // namespace external_command
