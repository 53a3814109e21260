// SPDX-License-Identifier: Apache-2.0
#include "lane_cuts.h"

#include <algorithm>
#include <cmath>

#include "corridor.h"
#include "line_mending.h"
#include "path_shape.h"
#include "smoothing.h"

namespace external_command {

namespace {

constexpr double kShare = 0.5;          // of what the vehicle can do that a calm place may ask for
constexpr double kApart = 25.0;         // [m]
constexpr double kLongestLane = 20e3;   // a longer one is looked at only where it is driven [m]
constexpr double kInnerSpacing = 0.05;  // beside a boundary that is kept, at least [m]

class CalmStretches {
 public:
  CalmStretches(const PathMaking& making, LaneIndex lane)
      : making_(making), corridor_(making.map, making.vehicle), lane_(lane) {
    const Polyline& center = making.map.lane(lane).center;
    const auto count = static_cast<std::size_t>(std::max(2.0, std::ceil(center.length() / making.params.spacing)));
    step_ = center.length() / static_cast<double>(count);
    for (std::size_t i = 0; i <= count; ++i) points_.push_back(center.pointAt(step_ * static_cast<double>(i)));
    smooth(kSmoothingLength / step_, kNone, kNone, &points_);
    markFolds(center);
  }

  LaneCuts cuts() const {
    LaneCuts cuts;
    const auto reach = static_cast<std::size_t>(std::ceil(kSectionOverlap / step_));
    const auto apart = static_cast<std::size_t>(std::ceil(kApart / step_));
    std::size_t calm = 0;  // points in a row
    std::size_t next = 0;  // that may be a place
    for (std::size_t i = 0; i < points_.size(); ++i) {
      calm = isCalm(i) ? calm + 1 : 0;
      if (calm <= 2 * reach || i < reach + next) continue;
      cuts.places.push_back(step_ * static_cast<double>(i - reach));
      next = i - reach + apart;
    }
    const double middle = 0.5 * step_ * static_cast<double>(points_.size() - 1);
    for (std::size_t k = 1; k < cuts.places.size(); ++k) {
      if (std::abs(cuts.places[k] - middle) < std::abs(cuts.places[cuts.main] - middle)) cuts.main = k;
    }
    return cuts;
  }

 private:
  /// Folds are left out of a path, and what is straight may go back and forth.
  void markFolds(const Polyline& center) {
    is_folded_.assign(points_.size(), false);
    const std::vector<std::size_t> kept = withoutFolds(center.points());
    for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
      if (kept[k + 1] == kept[k] + 1) continue;
      const auto first = static_cast<std::size_t>(center.arcLengths()[kept[k]] / step_);
      const auto last = static_cast<std::size_t>(center.arcLengths()[kept[k + 1]] / step_) + 1;
      for (std::size_t i = first; i <= std::min(last, points_.size() - 1); ++i) is_folded_[i] = true;
    }
  }

  double kappaAt(std::size_t i) const {
    if (i == 0 || i + 1 >= points_.size()) return 0.0;
    return cross(points_[i] - points_[i - 1], points_[i + 1] - points_[i]) / (step_ * step_ * step_);
  }

  bool isCalm(std::size_t i) const {
    if (is_folded_[i]) return false;
    const VehicleParams& vehicle = making_.vehicle;
    const double kappa = kappaAt(i), change = std::abs(kappaAt(i + 1) - kappa) / step_;
    if (std::abs(kappa) > kShare * vehicle.maxKappa()) return false;
    if (change > kShare * fastestChangeOfKappa(vehicle)) return false;
    const LanePoint place{lane_, step_ * static_cast<double>(i)};
    const CoursePoint here{points_[i], 0.0, place, place};
    const double front = vehicle.wheelbase + vehicle.front_overhang;
    const double swing = 0.5 * std::abs(kappa) * front * front;
    return swing + vehicle.width / 2.0 + kInnerSpacing <= corridor_.narrowest(here);
  }

  const PathMaking& making_;
  const Corridor corridor_;
  const LaneIndex lane_;
  double step_ = 0.0;
  std::vector<Point2d> points_;
  std::vector<bool> is_folded_;
};

}  // namespace

LaneCuts laneCuts(const PathMaking& making, LaneIndex lane) {
  const double length = making.map.lane(lane).length();
  if (length < 2.0 * kSectionOverlap || length > kLongestLane) return {};
  return CalmStretches(making, lane).cuts();
}

}  // namespace external_command
