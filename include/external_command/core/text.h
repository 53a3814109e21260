// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sstream>
#include <string>

#include "external_command/core/pose.h"

namespace external_command {

/// The arguments one after the other, as `operator<<` prints them: `text("lane ", id, " ends")`.
template <class... Args>
std::string text(const Args&... args) {
  std::ostringstream out;
  out.precision(10);
  (out << ... << args);
  return out.str();
}

/// "(12.30, 4.50)" [m].
std::string at(const Point2d& point);

/// "(12.30, 4.50, 1.571)" [m, rad].
std::string at(const Pose2d& pose);

/// "7.10 m".
std::string metres(double length);

/// "3.14 rad".
std::string radians(double angle);

/// "0.35 s".
std::string seconds(double time);

}  // namespace external_command
