// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/text.h"

#include <cmath>
#include <cstdio>

namespace external_command {

namespace {

constexpr double kLongest = 1e12;  // beyond that nobody reads a number digit by digit

std::string fixed(double number, int decimals = 2) {
  char buffer[40];
  std::snprintf(buffer, sizeof(buffer), std::abs(number) < kLongest ? "%.*f" : "%.*g", decimals, number);
  return buffer;
}

}  // namespace

std::string at(const Point2d& point) { return "(" + fixed(point.x()) + ", " + fixed(point.y()) + ")"; }

std::string at(const Pose2d& pose) {
  return "(" + fixed(pose.x) + ", " + fixed(pose.y) + ", " + fixed(pose.heading, 3) + ")";
}

std::string metres(double length) { return fixed(length) + " m"; }

std::string radians(double angle) { return fixed(angle) + " rad"; }

std::string seconds(double time) { return fixed(time) + " s"; }

}  // namespace external_command
