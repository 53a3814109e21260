// SPDX-License-Identifier: Apache-2.0
#include "zone_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace external_command {

namespace {

constexpr double kLookAhead = 15.0;     // along the path; neighbouring swaths must not be taken for the present one [m]
constexpr double kFarthest = 3.0;       // from the path [m]
constexpr double kHeadingWeight = 2.0;  // of a radian, as distance [m]

}  // namespace

ZoneTracker::ZoneTracker(Path path, std::vector<Swath> swaths) : path_(std::move(path)), swaths_(std::move(swaths)) {}

void ZoneTracker::update(const Pose2d& vehicle) {
  double best = kFarthest;
  std::size_t nearest = reached_;
  for (std::size_t i = reached_; i < path_.size() && path_[i].s <= path_[reached_].s + kLookAhead; ++i) {
    const double turn = std::abs(angleBetween(path_[i].heading, vehicle.heading));
    const double distance = (path_[i].pose().position() - vehicle.position()).norm() + kHeadingWeight * turn;
    if (distance < best) {
      best = distance;
      nearest = i;
    }
  }
  reached_ = nearest;
  while (current_ < swaths_.size() && reached_ + 1 >= swaths_[current_].last) ++current_;
}

double ZoneTracker::coveredArea() const {
  double area = 0.0;
  for (std::size_t i = 0; i < current_; ++i) area += swaths_[i].covered_area;
  if (current_ == swaths_.size()) return area;
  const Swath& now = swaths_[current_];
  const double share = now.length > 0.0 ? (path_[reached_].s - path_[now.first].s) / now.length : 0.0;
  return area + std::clamp(share, 0.0, 1.0) * now.covered_area;
}

}  // namespace external_command
