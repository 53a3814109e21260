// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <optional>
#include <string>

#include "external_command/core/pose.h"

namespace external_command {

/// The vehicle's pose, and other frames, by tf2. Thread-safe; never waits.
class VehiclePose {
 public:
  /// @param max_age  a vehicle pose older than this counts as missing [s].
  VehiclePose(std::string map_frame, std::string base_frame, double max_age);

  /// Pose of `base_frame` in `map_frame`.
  /// @throws NotReady  there is none, or it is too old; the text names the frames and the age.
  Pose2d get() const;

  /// Height of `base_frame` in `map_frame` [m]; nullopt where it is not known: a localization in the plane says 0.
  std::optional<double> height() const;

  /// Pose of the frame `given` in `map_frame`; the identity for `map_frame` itself and for "". A slash before its name
  /// does not belong to it, see frameId().
  /// @throws InvalidRequest  tf does not know how to get from one to the other.
  Pose2d ofFrame(const std::string& given) const;

 private:
  const std::string map_frame_, base_frame_;
  const double max_age_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
};

}  // namespace external_command
