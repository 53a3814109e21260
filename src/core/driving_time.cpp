// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/driving_time.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace external_command {

DrivingTime::DrivingTime(const VehicleParams& vehicle, std::shared_ptr<const Path> path, const SpeedOrder& order)
    : acceleration_(vehicle.max_acceleration),
      deceleration_(vehicle.max_deceleration),
      path_(std::move(path)),
      order_(order),
      to_end_(path_->size(), 0.0) {
  const Path& points = *path_;
  for (std::size_t i = points.size() - 1; i-- > 0;) {
    to_end_[i] = to_end_[i + 1] + stretch(limitAt(i), limitAt(i + 1), points[i + 1].s - points[i].s);
  }
}

double DrivingTime::limitAt(std::size_t point) const {
  const double limit = std::min((*path_)[point].speed, order_.most);
  return std::max(limit * order_.factor, std::min(limit, kLeastSpeed));
}

/// The speed changes evenly. A stretch between two stops is speeding up and braking.
double DrivingTime::stretch(double from_speed, double to_speed, double length) const {
  if (length <= 0.0) return 0.0;
  const double peak = std::sqrt(2.0 * length * acceleration_ * deceleration_ / (acceleration_ + deceleration_));
  if (from_speed + to_speed <= 0.0) return peak / acceleration_ + peak / deceleration_;
  return 2.0 * length / (from_speed + to_speed);
}

double DrivingTime::left(double s, double speed) const {
  const Path& points = *path_;
  const auto isBefore = [](double place, const ReferencePoint& point) { return place < point.s; };
  const auto next = std::upper_bound(points.begin(), points.end(), s, isBefore);
  double time = 0.0;
  for (auto i = static_cast<std::size_t>(next - points.begin()); i < points.size(); ++i) {
    const double length = points[i].s - s;
    const double reachable = std::sqrt(speed * speed + 2.0 * acceleration_ * length);
    const double limit = limitAt(i);
    const double speed_there = std::min(limit, reachable);
    time += stretch(speed, speed_there, length);
    if (speed_there >= limit) return time + to_end_[i];  // as fast as the path allows from here on
    s = points[i].s;
    speed = speed_there;
  }
  return time;
}

}  // namespace external_command
