// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/text.h"

#include <cstdio>

namespace external_command {

namespace {

template <class... Args>
std::string formatted(const char* format, Args... args) {
  char buffer[160];
  std::snprintf(buffer, sizeof(buffer), format, args...);
  return buffer;
}

}  // namespace

std::string at(const Point2d& point) { return formatted("(%.2f, %.2f)", point.x(), point.y()); }

std::string at(const Pose2d& pose) { return formatted("(%.2f, %.2f, %.3f)", pose.x, pose.y, pose.heading); }

std::string metres(double length) { return formatted("%.2f m", length); }

std::string radians(double angle) { return formatted("%.2f rad", angle); }

std::string seconds(double time) { return formatted("%.2f s", time); }

}  // namespace external_command
