// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/Transform.h>

#include <optional>
#include <string>

#include "external_command/core/pose.h"
#include "external_command/ros/transform_feed.h"

namespace external_command {

/// The vehicle's pose, and other frames, by tf2. Thread-safe; never waits.
class VehiclePose {
 public:
  /// @param max_age           a vehicle pose older than this counts as missing [s].
  /// @param max_future_stamp  and one stamped further ahead of now too [s].
  VehiclePose(std::string map_frame, std::string base_frame, double max_age, double max_future_stamp);

  /// Pose of `base_frame` in `map_frame`.
  /// @throws NotReady  there is none, it is too old, or of the future; the text names the frames and the age.
  Pose2d get() const;

  /// Of the newest transform, whether or not get() takes it [s]; 0 of one that always holds, nullopt where there is
  /// none.
  std::optional<double> age() const;

  /// Height of `base_frame` in `map_frame` [m]; nullopt where it is not known: a localization in the plane says 0.
  std::optional<double> height() const;

  /// Pose of the frame `given` in `map_frame`; the identity for `map_frame` itself and for "". A slash before its name
  /// does not belong to it, see frameId().
  /// @throws InvalidRequest  tf does not know how to get from one to the other.
  /// @throws NotReady        it is `base_frame`, or a frame that the vehicle carries, and get() throws.
  Pose2d ofFrame(const std::string& given) const;

  /// Height of the origin of that frame [m].
  /// @throws  as ofFrame()
  double heightOfFrame(const std::string& given) const;

 private:
  /// nullopt for `map_frame_` itself. @throws  as ofFrame()
  std::optional<geometry_msgs::Transform> transformOf(const std::string& given) const;

  /// What tells of transforms that were refused, to be added to an error's text.
  std::string refusal() const;

  const std::string map_frame_, base_frame_;
  const double max_age_, max_future_stamp_;
  const TransformFeed feed_;
};

}  // namespace external_command
