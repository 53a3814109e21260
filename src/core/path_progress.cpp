// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_progress.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace external_command {

namespace {

constexpr double kLookAhead = 15.0;  // along the path; a neighbouring stretch must not be taken for the present one [m]
constexpr double kFastest = 30.0;    // by which the stretch grows [m/s]
constexpr double kFarthest = 3.0;    // from the path [m]
constexpr double kHeadingWeight = 2.0;  // of a radian, as distance [m]

}  // namespace

PathProgress::PathProgress(std::shared_ptr<const Path> path) : path_(std::move(path)), along_(path_->front().s) {}

void PathProgress::update(const Pose2d& vehicle, double now) {
  const Path& path = *path_;
  double best = kFarthest;
  std::size_t nearest = reached_;
  const double last = path[reached_].s + kLookAhead + kFastest * (now - counted_.value_or(now));
  for (std::size_t i = reached_; i < path.size() && path[i].s <= last; ++i) {
    const double turn = std::abs(angleBetween(path[i].heading, vehicle.heading));
    const double distance = (path[i].pose().position() - vehicle.position()).norm() + kHeadingWeight * turn;
    if (distance < best) {
      best = distance;
      nearest = i;
    }
  }
  reached_ = nearest;
  if (best < kFarthest) along_ = std::max(along_, alongBeside(vehicle));
  if (best < kFarthest || !counted_) counted_ = now;
}

/// Of a vehicle beside the point that was reached, between that before it and that behind it.
double PathProgress::alongBeside(const Pose2d& vehicle) const {
  const Path& path = *path_;
  const ReferencePoint& point = path[reached_];
  const double gear = signOf(point.direction);
  const double ahead = gear * unitVector(point.heading).dot(vehicle.position() - point.pose().position());
  const double before = path[reached_ > 0 ? reached_ - 1 : 0].s;
  const double behind = path[std::min(reached_ + 1, path.size() - 1)].s;
  return std::clamp(point.s + ahead, before, behind);
}

}  // namespace external_command
