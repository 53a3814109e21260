// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/display.h"

#include <ros/single_subscriber_publisher.h>

#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kDrawPeriod = 0.05;  // [s]

}  // namespace

void requireAdvertised(bool is_advertised, const std::string& topic, const std::string& type) {
  if (is_advertised) return;
  throw InternalError(text("topic ", topic, " cannot be published as ", type,
                           ": this process publishes another type there; give one of the two another name"));
}

Display::Display(ros::NodeHandle nh, const DisplayParams& params, std::shared_ptr<const HdMap> map)
    : params_(params), map_(std::move(map)), lane_(LaneOptions{"the display's lane", 1, LanePriority::kBackground}) {
  nh.setCallbackQueue(lane_.queue());
  const ros::SubscriberStatusCallback greet_new = [this](const ros::SingleSubscriberPublisher& s) { greet(s); };
  markers_publisher_ = nh.advertise<visualization_msgs::MarkerArray>(
      params_.markers_topic, 10, greet_new, ros::SubscriberStatusCallback(), ros::VoidConstPtr(), true);
  requireAdvertised(markers_publisher_, nh.resolveName(params_.markers_topic), "visualization_msgs/MarkerArray");
  ros::SteadyTimerOptions options;
  options.period = ros::WallDuration(kDrawPeriod);
  options.callback = [this](const ros::SteadyTimerEvent&) { drawNewest(); };
  options.callback_queue = lane_.queue();
  timer_ = nh.createSteadyTimer(options);
}

void Display::greet(const ros::SingleSubscriberPublisher& subscriber) const {
  visualization_msgs::MarkerArray array;
  if (map_) array = mapMarkers(*map_, params_.map_frame);
  array.markers.push_back(vehicleMarker(params_.vehicle, params_.base_frame));
  subscriber.publish(array);
}

void Display::show(CommandScene scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  sent_ = std::move(scene);
  refused_.reset();
}

void Display::showRefused(CommandScene scene) {
  const std::lock_guard<std::mutex> lock(mutex_);
  refused_ = std::move(scene);
}

void Display::drawNewest() {
  std::optional<CommandScene> sent, refused;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    sent.swap(sent_);
    refused.swap(refused_);
  }
  for (const auto& scene : {sent, refused}) {
    if (!scene) continue;
    markers_publisher_.publish(commandMarkers(*scene, map_.get(), params_.vehicle, params_.map_frame));
  }
}

}  // namespace external_command
