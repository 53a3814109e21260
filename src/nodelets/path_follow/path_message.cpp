// SPDX-License-Identifier: Apache-2.0
#include "path_message.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/conversions.h"
#include "external_command/ros/frame_id.h"

namespace external_command {

namespace {

using Quaternion = geometry_msgs::Quaternion;

bool isUnset(const Quaternion& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0; }

/// The yaw of a quaternion of any length.
double headingOf(const Quaternion& given, std::size_t index) {
  const double size = std::max({std::abs(given.x), std::abs(given.y), std::abs(given.z), std::abs(given.w)});
  const bool is_finite =
      std::isfinite(given.x) && std::isfinite(given.y) && std::isfinite(given.z) && std::isfinite(given.w);
  if (!is_finite || size == 0.0) {
    throw InvalidRequest(text("poses[", index, "].pose.orientation is ",
                              is_finite ? "zero, while others are not" : "not finite",
                              "; give all poses an orientation, or leave all but the last at the identity"));
  }
  const double x = given.x / size, y = given.y / size, z = given.z / size, w = given.w / size;
  return std::atan2(2.0 * (w * z + x * y), w * w + x * x - y * y - z * z);
}

/// Takes poses from their frames to that of the command.
class Frames {
 public:
  Frames(const nav_msgs::Path& path, const FrameLookup& pose_of) : path_(path), pose_of_(pose_of) {
    const auto is_same = [&](const auto& stamped) { return frameOf(stamped) == frameOf(path.poses.front()); };
    are_one_ = std::all_of(path.poses.begin(), path.poses.end(), is_same);
  }

  /// Of the command; empty: the map's.
  std::string name() const {
    if (path_.poses.empty()) return frameId(path_.header.frame_id);
    return are_one_ ? frameOf(path_.poses.front()) : "";
  }

  /// The frame of a pose, seen from the command's.
  Pose2d of(const geometry_msgs::PoseStamped& stamped, std::size_t index) {
    if (are_one_ && index > 0) return {};
    const std::string frame = frameOf(stamped);
    auto known = known_.find(frame);
    if (known == known_.end()) known = known_.emplace(frame, lookUp(stamped, index)).first;
    return are_one_ ? Pose2d() : known->second;
  }

 private:
  Pose2d lookUp(const geometry_msgs::PoseStamped& stamped, std::size_t index) const {
    try {
      return pose_of_(frameOf(stamped));
    } catch (const InvalidRequest& error) {
      if (frameId(stamped.header.frame_id).empty()) throw;
      throw InvalidRequest(text("poses[", index, "].", error.what()));
    }
  }

  std::string frameOf(const geometry_msgs::PoseStamped& stamped) const {
    const std::string own = frameId(stamped.header.frame_id);
    return own.empty() ? frameId(path_.header.frame_id) : own;
  }

  const nav_msgs::Path& path_;
  const FrameLookup& pose_of_;
  bool are_one_ = true;
  std::map<std::string, Pose2d> known_;
};

bool hasHeadings(const nav_msgs::Path& path) {
  if (path.poses.empty()) return false;
  return !std::all_of(path.poses.begin(), path.poses.end() - 1,
                      [](const auto& stamped) { return isUnset(stamped.pose.orientation); });
}

}  // namespace

PathFollowCommand toPathFollowCommand(const nav_msgs::Path& path, const FrameLookup& pose_of) {
  Frames frames(path, pose_of);
  const bool has_headings = hasHeadings(path);
  PathFollowCommand command;
  command.header = path.header;
  command.header.frame_id = frames.name();
  for (std::size_t i = 0; i < path.poses.size(); ++i) {
    const geometry_msgs::Pose& pose = path.poses[i].pose;
    const Pose2d frame = frames.of(path.poses[i], i);
    requirePlace(pose.position, "poses", i, ".pose.position");
    command.way_point.push_back(toPointMsg(toMapPoint(pose.position, frame)));
    if (has_headings) command.heading.push_back(headingOf(pose.orientation, i) + frame.heading);
    if (has_headings || i + 1 < path.poses.size() || isUnset(pose.orientation)) continue;
    command.has_end_heading = true;
    command.end_heading = headingOf(pose.orientation, i) + frame.heading;
  }
  return command;
}

}  // namespace external_command
