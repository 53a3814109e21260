// SPDX-License-Identifier: Apache-2.0
#include "parking_poses.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/multi_point.hpp>
#include <boost/geometry/geometries/polygon.hpp>

#include "core/boost_point.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kSlack = 0.02;  // beyond the margin, so that rounding does not block a goal [m]
constexpr double kEasy = 0.03;   // beyond the margin, wished for where the vehicle is moved aside anyway [m]
constexpr int kSteps = 8;        // of the tolerances to either side, that are tried

ParkingDirection readDirection(const ParameterReader& reader) {
  std::string word = "cheaper";
  reader.read("parking_direction", &word);
  if (word == "nose_in") return ParkingDirection::kNoseIn;
  if (word == "backing_in") return ParkingDirection::kBackingIn;
  if (word == "cheaper") return ParkingDirection::kCheaper;
  throw InvalidParameter(
      text("parameter ", reader.nameOf("parking_direction"), " is '", word, "'; give nose_in, backing_in or cheaper"));
}

}  // namespace

ParkingParams readParkingParams(const ParameterReader& reader) {
  ParkingParams params;
  params.direction = readDirection(reader);
  reader.readWithin("parking_position_tolerance", 0.0, 2.0, &params.position_tolerance);
  reader.readWithin("parking_heading_tolerance", 0.0, 0.5, &params.heading_tolerance);
  reader.readWithin("parking_max_overhang", 0.0, 10.0, &params.max_overhang);
  return params;
}

ParkingSpot::ParkingSpot(const ParkingSpace& space, const VehicleParams& vehicle, double margin,
                         const ParkingParams& params)
    : space_(space), vehicle_(vehicle), margin_(margin), params_(params) {
  // In the frame of the space's heading the middle of its bounding box is the middle of the space.
  const Point2d& corner0 = space.polygon.points()[0];
  const Pose2d frame{corner0.x(), corner0.y(), space.heading};
  Point2d low = Point2d::Zero(), high = Point2d::Zero();
  for (const Point2d& corner : space.polygon.points()) {
    const Point2d local = relativeTo(frame, {corner.x(), corner.y(), 0.0}).position();
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  length_ = high.x() - low.x();
  width_ = high.y() - low.y();
  // In a space that is too short the vehicle sticks out towards the lane, not beyond the far end.
  const double farthest = high.x() - margin - kSlack - vehicle.length() / 2.0;
  const double x = std::min((low.x() + high.x()) / 2.0, farthest);
  ahead_of_middle_ = farthest - x;
  middle_ = compose(frame, {x, (low.y() + high.y()) / 2.0, 0.0});
}

bool ParkingSpot::isSmall() const { return length_ < vehicle_.length() || width_ < vehicle_.width; }

std::string ParkingSpot::shortage() const {
  const bool is_short = length_ < vehicle_.length() - params_.max_overhang;
  const bool is_narrow = width_ < vehicle_.width - params_.position_tolerance;
  if (!is_short && !is_narrow) return "";
  return text("it is ", metres(length_), " long and ", metres(width_), " wide; the vehicle is ",
              metres(vehicle_.length()), " x ", metres(vehicle_.width), " (~vehicle), and may stick out by ",
              is_short ? metres(params_.max_overhang) : metres(params_.position_tolerance),
              is_short ? " (~parking_max_overhang)" : " (~parking_position_tolerance)");
}

std::vector<Pose2d> ParkingSpot::posesAt(const Pose2d& offset) const {
  const Pose2d middle = compose(middle_, offset);
  const double ahead = vehicle_.length() / 2.0 - vehicle_.rear_overhang;
  const Pose2d nose_in = compose(middle, {-ahead, 0.0, 0.0});
  const Pose2d backing_in = compose(middle, {ahead, 0.0, M_PI});
  if (params_.direction == ParkingDirection::kNoseIn) return {nose_in};
  if (params_.direction == ParkingDirection::kBackingIn) return {backing_in};
  return {nose_in, backing_in};
}

/// The offsets within the tolerances, the smallest first.
std::vector<Pose2d> ParkingSpot::offsets() const {
  std::vector<std::pair<double, Pose2d>> sized;
  for (int x = -kSteps; x <= kSteps; ++x) {
    for (int y = -kSteps; y <= kSteps; ++y) {
      for (int turn = -kSteps; turn <= kSteps; ++turn) {
        const double distance = std::hypot(x, y) / kSteps;
        const double dx = params_.position_tolerance * x / kSteps;
        if (distance > 1.0 || dx > ahead_of_middle_) continue;
        const Pose2d offset{dx, params_.position_tolerance * y / kSteps, params_.heading_tolerance * turn / kSteps};
        sized.emplace_back(distance + static_cast<double>(std::abs(turn)) / kSteps, offset);
      }
    }
  }
  std::stable_sort(sized.begin(), sized.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Pose2d> offsets;
  for (const auto& [size, offset] : sized) offsets.push_back(offset);
  return offsets;
}

std::vector<Pose2d> ParkingSpot::freePoses(const CollisionChecker& obstacles) const {
  const std::vector<Pose2d> tried = offsets();
  std::vector<Pose2d> free;
  for (std::size_t i = 0; i < poses().size(); ++i) {
    const auto nearest = [&](double more) {
      return std::find_if(tried.begin(), tried.end(), [&](const Pose2d& offset) {
        const Pose2d pose = posesAt(offset)[i];
        return obstacles.isFree(pose) && obstacles.clearance(pose, 1.0) >= margin_ + more;
      });
    };
    // A goal that only just keeps the margin is hard to reach.
    const bool middle_is_free = obstacles.isFree(posesAt(tried.front())[i]);
    auto found = middle_is_free ? tried.begin() : nearest(kEasy);
    if (found == tried.end()) found = nearest(0.0);
    if (found != tried.end()) free.push_back(posesAt(*found)[i]);
  }
  return free;
}

Pose2d ParkingSpot::offsetOf(const Pose2d& pose) const {
  const double ahead = vehicle_.length() / 2.0 - vehicle_.rear_overhang;
  Pose2d middle = compose(pose, {ahead, 0.0, 0.0});
  if (std::abs(angleBetween(space_.heading, pose.heading)) > M_PI / 2.0) middle.heading += M_PI;
  return relativeTo(middle_, middle);
}

Polygon ParkingSpot::placeFor(const std::vector<Pose2d>& parked) const {
  boost::geometry::model::multi_point<Point2d> points;
  const Point2d origin = middle_.position();  // UTM coordinates would eat the digits
  const auto add = [&](const Point2d& point) { points.push_back(point - origin); };
  for (const Point2d& corner : space_.polygon.points()) add(corner);
  for (const Pose2d& pose : parked) {
    for (const Point2d& corner : footprintAt(vehicle_, pose, margin_ + kSlack)) add(corner);
  }
  boost::geometry::model::polygon<Point2d> hull;
  boost::geometry::convex_hull(points, hull);
  std::vector<Point2d> corners;
  for (const Point2d& point : hull.outer()) corners.push_back(origin + point);
  return Polygon(corners, text("parking space ", space_.id));
}

}  // namespace external_command
