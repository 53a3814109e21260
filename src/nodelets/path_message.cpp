// SPDX-License-Identifier: Apache-2.0
#include "path_message.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace external_command {

namespace {

bool isZero(const geometry_msgs::Quaternion& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0; }

bool isIdentity(const geometry_msgs::Quaternion& q) { return q.x == 0.0 && q.y == 0.0 && q.z == 0.0; }

double headingOf(const geometry_msgs::Quaternion& q) {
  if (isZero(q)) return std::numeric_limits<double>::quiet_NaN();
  return std::atan2(2.0 * (q.w * q.z + q.x * q.y), 1.0 - 2.0 * (q.y * q.y + q.z * q.z));
}

/// True where a vehicle with heading 0 all the way could drive the path.
bool runsAlongX(const nav_msgs::Path& path) {
  for (std::size_t i = 1; i < path.poses.size(); ++i) {
    const auto &from = path.poses[i - 1].pose.position, &to = path.poses[i].pose.position;
    if (std::abs(to.y - from.y) > std::abs(to.x - from.x)) return false;
  }
  return true;
}

bool hasHeadings(const nav_msgs::Path& path) {
  const auto all = [&](bool (*matches)(const geometry_msgs::Quaternion&)) {
    return std::all_of(path.poses.begin(), path.poses.end(),
                       [&](const auto& stamped) { return matches(stamped.pose.orientation); });
  };
  if (all(isZero)) return false;
  return !all(isIdentity) || runsAlongX(path);
}

}  // namespace

PathFollowCommand toPathFollowCommand(const nav_msgs::Path& path) {
  PathFollowCommand command;
  command.header = path.header;
  for (const auto& stamped : path.poses) command.way_point.push_back(stamped.pose.position);
  if (!hasHeadings(path)) return command;
  for (const auto& stamped : path.poses) command.heading.push_back(headingOf(stamped.pose.orientation));
  return command;
}

}  // namespace external_command
