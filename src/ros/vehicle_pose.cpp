// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/vehicle_pose.h"

#include <tf2/utils.h>

#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/ros/frame_id.h"

namespace external_command {

namespace {

Pose2d toPose(const geometry_msgs::Transform& transform) {
  return {transform.translation.x, transform.translation.y,
          tf2::getYaw(
              tf2::Quaternion(transform.rotation.x, transform.rotation.y, transform.rotation.z, transform.rotation.w))};
}

}  // namespace

VehiclePose::VehiclePose(std::string map_frame, std::string base_frame, double max_age, double max_future_stamp)
    : map_frame_(std::move(map_frame)),
      base_frame_(std::move(base_frame)),
      max_age_(max_age),
      max_future_stamp_(max_future_stamp),
      feed_(max_future_stamp) {}

Pose2d VehiclePose::get() const {
  geometry_msgs::TransformStamped transform;
  try {
    transform = feed_.store().lookup(map_frame_, base_frame_);
  } catch (const tf2::TransformException& error) {
    throw NotReady(text("the vehicle's pose is not known: no transform ", map_frame_, " -> ", base_frame_, " (",
                        error.what(), "); start the localization, or set ~map_frame and ~base_frame", refusal()));
  }
  // As numbers: a Duration throws where the difference is too great for it.
  const double age = ros::Time::now().toSec() - transform.header.stamp.toSec();
  const bool is_static = transform.header.stamp.isZero();
  if (!is_static && age > max_age_) {
    throw NotReady(text("the vehicle's pose is ", seconds(age), " old (transform ", map_frame_, " -> ", base_frame_,
                        "); the limit is ", seconds(max_age_), " (~max_pose_age): has the localization stopped?",
                        refusal()));
  }
  if (!is_static && -age > max_future_stamp_) {
    throw NotReady(text("the vehicle's pose is stamped ", seconds(-age), " in the future (transform ", map_frame_,
                        " -> ", base_frame_, "); the limit is ", seconds(max_future_stamp_),
                        " (~max_future_stamp): do the clocks agree?"));
  }
  const Pose2d pose = toPose(transform.transform);
  if (!pose.isFinite()) throw NotReady(text("the transform ", map_frame_, " -> ", base_frame_, " is not finite"));
  return pose;
}

std::optional<double> VehiclePose::age() const {
  try {
    const ros::Time stamp = feed_.store().lookup(map_frame_, base_frame_).header.stamp;
    return stamp.isZero() ? 0.0 : ros::Time::now().toSec() - stamp.toSec();
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::optional<double> VehiclePose::height() const {
  try {
    const double z = feed_.store().lookup(map_frame_, base_frame_).transform.translation.z;
    return z != 0.0 && std::isfinite(z) ? std::optional<double>(z) : std::nullopt;
  } catch (const tf2::TransformException&) {
    return std::nullopt;
  }
}

std::string VehiclePose::refusal() const {
  const std::string recent = feed_.recentRefusal();
  return recent.empty() ? recent : "; " + recent;
}

Pose2d VehiclePose::ofFrame(const std::string& given) const {
  const auto transform = transformOf(given);
  return transform ? toPose(*transform) : Pose2d();
}

double VehiclePose::heightOfFrame(const std::string& given) const {
  const auto transform = transformOf(given);
  return transform ? transform->translation.z : 0.0;
}

std::optional<geometry_msgs::Transform> VehiclePose::transformOf(const std::string& given) const {
  const std::string frame = frameId(given);
  if (frame.empty() || frame == map_frame_) return std::nullopt;
  // Throws where the vehicle's pose is missing or old: tf2 would go on to place there what the vehicle carries.
  if (feed_.store().isCarried(frame, base_frame_, map_frame_)) get();
  try {
    return feed_.store().lookup(map_frame_, frame).transform;
  } catch (const tf2::TransformException& error) {
    throw InvalidRequest(text("header.frame_id ", quoted(frame), " cannot be transformed to '", map_frame_,
                              "': ", printable(error.what(), 300), "; leave it empty for '", map_frame_, "'"));
  }
}

}  // namespace external_command
