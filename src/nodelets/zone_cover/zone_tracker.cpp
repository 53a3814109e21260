// SPDX-License-Identifier: Apache-2.0
#include "zone_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kLookAhead = 15.0;  // along the path; neighbouring swaths must not be taken for the present one [m]
constexpr double kFarthestFromPath = 3.0;  // from the path [m]
constexpr double kLeap = 60.0;             // along the path, from one pose to the next [m]
constexpr double kNear = 1.0;              // to the path after a leap [m]
constexpr double kHeadingWeight = 2.0;     // of a radian, as distance [m]
constexpr double kAheadWeight = 0.02;      // of a metre along the path: a lap ends where it begins
constexpr double kPassed = 0.05;           // before a point a vehicle that is about to stop counts as there [m]

}  // namespace

ZoneTracker::ZoneTracker(std::shared_ptr<const Path> path, std::vector<Swath> swaths)
    : path_(std::move(path)), swaths_(std::move(swaths)) {
  for (const Swath& swath : swaths_) {
    if (swath.first < swath.last && swath.last < path_->size()) continue;
    throw InternalError(text("swath ", swath.index, " lies at the points ", swath.first, " to ", swath.last,
                             " of a path of ", path_->size()));
  }
}

std::optional<std::size_t> ZoneTracker::nearest(const Pose2d& vehicle, double look_ahead, double farthest) const {
  const Path& path = *path_;
  std::optional<std::size_t> nearest;
  double best = farthest;
  for (std::size_t i = reached_; i < path.size() && path[i].s <= path[reached_].s + look_ahead; ++i) {
    const double turn = std::abs(angleBetween(path[i].heading, vehicle.heading));
    const double distance = (path[i].pose().position() - vehicle.position()).norm() + kHeadingWeight * turn +
                            kAheadWeight * (path[i].s - path[reached_].s);
    if (distance >= best) continue;
    best = distance;
    nearest = i;
  }
  return nearest;
}

void ZoneTracker::update(const Pose2d& vehicle) {
  std::optional<std::size_t> found = nearest(vehicle, kLookAhead, kFarthestFromPath);
  // A vehicle that was seen to leave the path has not swept what it comes back behind.
  if (!found && is_on_path_) found = nearest(vehicle, kLeap, kNear + kAheadWeight * kLeap);
  is_on_path_ = found.has_value();
  if (!found || *found == reached_) return;
  const ReferencePoint& point = (*path_)[*found];
  const double gear = static_cast<double>(point.direction);
  const double ahead = gear * unitVector(point.heading).dot(point.pose().position() - vehicle.position());
  reached_ = ahead > kPassed ? *found - 1 : *found;
  while (current_ < swaths_.size() && reached_ >= swaths_[current_].last) ++current_;
}

void ZoneTracker::finish() {
  reached_ = path_->size() - 1;
  current_ = swaths_.size();
}

double ZoneTracker::sweptOf(std::size_t position) const {
  const Swath& swath = swaths_[position];
  if (reached_ <= swath.first) return 0.0;
  const Path& path = *path_;
  const double whole = path[swath.last].s - path[swath.first].s;
  const double driven = path[std::min(reached_, swath.last)].s - path[swath.first].s;
  return swath.from + (whole > 0.0 ? driven / whole : 1.0) * swath.length;
}

double ZoneTracker::coveredArea() const {
  double area = 0.0;
  for (const Swath& swath : swaths_) {
    if (reached_ > swath.first) area += swath.covered[std::min(reached_, swath.last) - swath.first];
  }
  return area;
}

}  // namespace external_command
