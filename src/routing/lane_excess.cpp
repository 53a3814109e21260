// SPDX-License-Identifier: Apache-2.0
#include "lane_excess.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace external_command {

namespace {

constexpr double kTold = 0.2;      // less is not worth a word [m]
constexpr double kMerging = 0.05;  // off the course, where the path has yet to get onto it [m]

class ExcessCheck {
 public:
  ExcessCheck(const Corridor& corridor, const VehicleParams& vehicle, const std::vector<CoursePoint>& course,
              const CourseLayout& layout, const Path& path)
      : corridor_(corridor),
        vehicle_(vehicle),
        course_(course),
        layout_(layout),
        path_(path),
        step_(path.back().s / static_cast<double>(path.size() - 1)),
        front_(vehicle.wheelbase + vehicle.front_overhang) {}

  /// By how much the vehicle leaves its lanes at point `i` of the path; 0 where it does not [m].
  double at(std::size_t i) {
    const ReferencePoint& point = path_[i];
    const CoursePoint& place = course_[layout_.places[layout_.first + i]];
    const double offset = (point.pose().position() - place.position).norm();
    const double swing = offset + 0.5 * std::abs(point.kappa) * front_ * front_;
    const double needed = swing + vehicle_.width / 2.0 - kTold;
    if (needed <= leastRoomOn(place.lane.lane) || needed <= corridor_.narrowest(place)) return 0.0;
    return std::max({excess(i, front_), excess(i, 0.0), excess(i, -vehicle_.rear_overhang)});
  }

  /// The place on the course abreast of what is `ahead` [m] of point `i`.
  std::size_t placeOf(std::size_t i, double ahead) const {
    const auto here = static_cast<double>(layout_.places[layout_.first + i]);
    const double there = std::round(here + ahead / step_);
    return static_cast<std::size_t>(std::clamp(there, 0.0, static_cast<double>(course_.size() - 1)));
  }

 private:
  double leastRoomOn(LaneIndex lane) {
    if (lane != known_lane_) least_room_ = corridor_.narrowestOf(known_lane_ = lane);
    return least_room_;
  }

  /// Of both ends of the line across the vehicle that is `ahead` [m] of point `i`.
  double excess(std::size_t i, double ahead) const {
    const std::size_t there = placeOf(i, ahead);
    const std::size_t before = there == 0 ? 0 : there - 1, after = std::min(there + 1, course_.size() - 1);
    const Point2d way = (course_[after].position - course_[before].position).normalized();
    FitPoint limits;
    limits.base = course_[there].position;
    limits.normal = {-way.y(), way.x()};
    corridor_.limit(course_[there], &limits);
    const Pose2d pose = path_[i].pose();
    double most = 0.0;
    for (const double side : {-vehicle_.width / 2.0, vehicle_.width / 2.0}) {
      const Point2d corner = compose(pose, {ahead, side, 0.0}).position();
      const double offset = (corner - limits.base).dot(limits.normal);
      const double half = vehicle_.width / 2.0;
      most = std::max({most, offset - (limits.high + half), (limits.low - half) - offset});
    }
    return most;
  }

  const Corridor& corridor_;
  const VehicleParams& vehicle_;
  const std::vector<CoursePoint>& course_;
  const CourseLayout& layout_;
  const Path& path_;
  const double step_, front_;
  LaneIndex known_lane_ = std::numeric_limits<LaneIndex>::max();
  double least_room_ = 0.0;  // on that lane [m]
};

}  // namespace

std::vector<LeftLane> leftLanes(const Corridor& corridor, const VehicleParams& vehicle,
                                const std::vector<CoursePoint>& course, const std::vector<Point2d>& wished,
                                const CourseLayout& layout, const Path& path) {
  ExcessCheck check(corridor, vehicle, course, layout, path);
  std::vector<LeftLane> left;
  bool is_out = false;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const std::size_t place = layout.places[layout.first + i];
    const bool merges = (wished[place] - course[place].position).norm() > kMerging;
    const double excess = merges ? 0.0 : check.at(i);
    const bool was_out = is_out;
    is_out = excess > kTold;
    if (!is_out) continue;
    if (!was_out) left.emplace_back();
    if (excess > left.back().excess) left.back() = {course[place].lane.lane, path[i].pose().position(), excess};
  }
  return left;
}

}  // namespace external_command
