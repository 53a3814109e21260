// SPDX-License-Identifier: Apache-2.0
#include "path_section.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "bend_relief.h"
#include "lane_cuts.h"
#include "lane_excess.h"
#include "smoothing.h"
#include "start_merge.h"

namespace external_command {

namespace {

constexpr double kPoint = 1e-3;            // [m]; shorter is one point; also of a spacing
constexpr double kLead = 5.0;              // beyond the ends of the route [m]
constexpr double kMaxLead = 400.0;         // samples beyond the ends
constexpr double kSlowest = 1.0;           // that the steering slows the vehicle down to [m/s]
constexpr std::size_t kBehindVehicle = 3;  // samples, that hold its heading
constexpr double kTolerance = 1.02;        // of the sampled curvature

/// The headings of directions that turn little from one to the next, for less than an arc tangent each.
class Headings {
 public:
  double next(const Point2d& direction) {
    const double along = last_.dot(direction), across = cross(last_, direction);
    last_ = direction;
    if (++since_exact_ > kMostInRow || !(std::abs(across) < kSmallTangent * along)) {
      since_exact_ = 0;
      return heading_ = headingOf(direction);
    }
    const double t = across / along, tt = t * t;
    heading_ += t * (1.0 - tt * (1.0 / 3 - tt * (1.0 / 5 - tt * (1.0 / 7 - tt * (1.0 / 9 - tt / 11)))));
    if (std::abs(heading_) > kNearlyBack) heading_ = headingOf(direction);
    return heading_;
  }

 private:
  static constexpr double kSmallTangent = 0.1;  // up to which the series is exact to 1e-14
  static constexpr double kNearlyBack = 3.14;   // the sign is to be that of the direction itself [rad]
  static constexpr int kMostInRow = 64;

  Point2d last_ = Point2d::Zero();
  double heading_ = 0.0;
  int since_exact_ = 0;
};

/// The path through points[first] ... points[last]; the points beyond serve as neighbours.
Path pathThrough(const std::vector<Point2d>& points, std::size_t first, std::size_t last) {
  Path path(last - first + 1);
  Headings headings;
  for (std::size_t i = first; i <= last; ++i) {
    // The parabola through three points; at the ends, through the nearest three.
    const std::size_t middle = std::clamp<std::size_t>(i, 1, points.size() - 2);
    const Point2d bend = points[middle - 1] - 2.0 * points[middle] + points[middle + 1];
    const double off_middle = static_cast<double>(i) - static_cast<double>(middle);
    const Point2d slope = 0.5 * (points[middle + 1] - points[middle - 1]) + off_middle * bend;
    const double squared = std::max(slope.squaredNorm(), 1e-12);
    ReferencePoint& point = path[i - first];
    point.x = points[i].x();
    point.y = points[i].y();
    point.heading = headings.next(slope);
    point.kappa = cross(slope, bend) / (squared * std::sqrt(squared));
    if (i == first) continue;
    // As setArcLengths() would have it, but for a fraction of the time: arc over chord is 1 + (turn / 2)^2 / 6 + ...
    const ReferencePoint& previous = path[i - first - 1];
    const double chord = (points[i] - points[i - 1]).norm();
    const double half_turn = 0.25 * (previous.kappa + point.kappa) * chord;
    point.s = previous.s + chord * (1.0 + half_turn * half_turn / 6.0);
  }
  return path;
}

/// The speed at which the steering can follow from a point to the next; not below a crawl.
double followedSpeed(const VehicleParams& vehicle, const ReferencePoint& from, const ReferencePoint& to) {
  // The wheels turn by this at most, which is quick to tell, and enough nearly everywhere.
  const double most = vehicle.wheelbase * std::abs(to.kappa - from.kappa);
  const double reachable = vehicle.max_steering_rate * (to.s - from.s);
  if (reachable >= most * std::max(from.speed, to.speed)) return std::max(from.speed, to.speed);
  return std::max(kSlowest, steeringSpeed(vehicle, from, to));
}

void capSpeeds(const std::vector<CoursePoint>& course, const CourseLayout& layout, const VehicleParams& vehicle,
               Path* path) {
  for (std::size_t i = 0; i < path->size(); ++i) {
    ReferencePoint& point = (*path)[i];
    point.speed = course[layout.places[layout.first + i]].speed_limit;
    if (i == 0) continue;
    ReferencePoint& before = (*path)[i - 1];
    const double speed = followedSpeed(vehicle, before, point);
    before.speed = std::min(before.speed, speed);
    point.speed = std::min(point.speed, speed);
  }
}

/// The stretches above the vehicle's curvature.
std::vector<TightLane> tightLanes(const std::vector<CoursePoint>& course, const CourseLayout& layout, double max_kappa,
                                  const Path& path) {
  std::vector<TightLane> tight;
  double worst = 0.0;  // on the present stretch
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double kappa = std::abs(path[i].kappa);
    if (kappa <= max_kappa * kTolerance) {
      worst = 0.0;
      continue;
    }
    if (worst == 0.0) tight.emplace_back();
    if (kappa > worst) {
      const LaneIndex lane = course[layout.places[layout.first + i]].lane.lane;
      tight.back() = {lane, path[i].pose().position(), 1.0 / kappa};
    }
    worst = std::max(worst, kappa);
  }
  return tight;
}

}  // namespace

ReferencePath sectionPath(const PathMaking& making, const PathSection& section, const std::optional<Pose2d>& start,
                          const CancelToken& cancel) {
  const VehicleParams& vehicle = making.vehicle;
  const CourseGeometry geometry(making.map, section.rows, section.follows ? kSectionOverlap : kLead,
                                section.goes_on ? kSectionOverlap : kLead, vehicle, making.params);
  cancel.throwIfCancelled();
  if (geometry.length() < kPoint) return {};
  const auto intervals =
      static_cast<std::size_t>(std::max(2.0, std::ceil(geometry.length() / making.params.spacing - kPoint)));
  const double step = geometry.length() / static_cast<double>(intervals);
  const auto lead_in = static_cast<std::size_t>(std::min(geometry.leadIn() / step, kMaxLead));
  const std::size_t before = start ? kBehindVehicle : lead_in;
  const auto after = static_cast<std::size_t>(std::min(geometry.leadOut() / step, kMaxLead));
  const std::vector<CoursePoint> course = geometry.sample(step, before, intervals + after, cancel);

  CourseLayout layout;
  layout.first = before;
  layout.last = before + intervals;
  std::vector<Point2d> wished;
  wished.reserve(course.size());
  for (const CoursePoint& point : course) wished.push_back(point.position);
  layout.starts_at_pose = start && isBeside(*start, wished, layout.first);
  if (start) mergeFrom(*start, layout.first, layout.last, step, vehicle.maxKappa(), &wished);
  layout.points = wished;
  layout.places.resize(course.size());
  std::iota(layout.places.begin(), layout.places.end(), 0);
  cancel.throwIfCancelled();
  smooth(kSmoothingLength / step, section.follows ? kNone : layout.first, section.goes_on ? kNone : layout.last,
         &layout.points);
  cancel.throwIfCancelled();
  const Corridor corridor(making.map, vehicle);
  BendRelief(corridor, vehicle, step, course, wished).apply(cancel, &layout);
  cancel.throwIfCancelled();

  ReferencePath result;
  result.path = pathThrough(layout.points, layout.first, layout.last);
  if (layout.starts_at_pose) result.path.front().heading = start->heading;
  capSpeeds(course, layout, vehicle, &result.path);
  result.left = leftLanes(corridor, vehicle, course, wished, layout, result.path);
  result.tight = tightLanes(course, layout, vehicle.maxKappa(), result.path);
  return result;
}

}  // namespace external_command
