// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/waypoint_path.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kRepeated = 1e-3;             // two points nearer than this are one [m]
constexpr double kSameHeading = 1e-3;          // [rad]
constexpr double kMaxBulge = 0.25;             // of the curve beside the straight line between two points [m]
constexpr double kMaxSmoothTurn = 0.6;         // of the curve against that line, at either end [rad]
constexpr double kMaxHeadingError = M_PI / 4;  // of a given heading against the line, there or back [rad]
constexpr double kCurvatureTolerance = 1.02;   // of the sampled curvature
constexpr std::size_t kPollInterval = 1000;    // points between two looks at the cancel token

/// Directions of motion [rad] in which the path arrives at a point and leaves it; they differ at a corner.
struct Tangents {
  double in = 0.0;
  double out = 0.0;

  double corner() const { return angleBetween(in, out); }
  double between() const { return in + 0.5 * corner(); }
};

/// A cubic Hermite piece stays within this of its chord, given the angle between chord and tangent at one end.
bool staysNear(double length, double angle) {
  return std::abs(angle) <= kMaxSmoothTurn && 4.0 / 27.0 * length * std::sin(std::abs(angle)) <= kMaxBulge;
}

/// The tangents at `here`: those of `wanted` where that is smooth, else of the circle through the three points, else
/// one nearer to the longer side, where the curve would leave the line more; a corner where none of these is smooth.
Tangents tangentsAt(const Point2d& before, const Point2d& here, const Point2d& after, std::optional<double> wanted) {
  const double length_in = (here - before).norm(), length_out = (after - here).norm();
  const double in = headingOf(here - before), out = headingOf(after - here);
  const double turn = angleBetween(in, out);
  const double share = length_in / (length_in + length_out);
  std::vector<double> candidates = {turn * share, turn * (1.0 - share)};
  if (wanted) candidates.insert(candidates.begin(), angleBetween(in, *wanted));
  for (const double angle : candidates) {
    if (staysNear(length_in, angle) && staysNear(length_out, turn - angle)) return {in + angle, in + angle};
  }
  return {in, out};
}

/// The tangent at an end of a chord: `wanted` where that is smooth, else that of an arc with `other` at its other end.
double tangentAtEnd(const Point2d& chord, double other, std::optional<double> wanted) {
  const double along = headingOf(chord);
  if (wanted && staysNear(chord.norm(), angleBetween(along, *wanted))) return *wanted;
  return along - angleBetween(along, other);
}

/// A line of which no point repeats the one before.
struct DistinctLine {
  WaypointLine line;
  std::vector<std::size_t> number;  ///< of each point in the list that was given
};

DistinctLine distinct(const WaypointLine& given) {
  DistinctLine result;
  WaypointLine& line = result.line;
  line.end_heading = given.end_heading;
  line.names = given.names;
  if (!given.headings.empty() && given.headings.size() != given.points.size()) {
    throw InvalidRequest(text(given.names.heading, " has ", given.headings.size(), " elements; ", given.names.point,
                              " has ", given.points.size()));
  }
  for (const WaypointPlace& place : placesOf(given.points)) {
    line.points.push_back(given.points[place.first]);
    if (!given.headings.empty()) line.headings.push_back(given.headings[place.last]);
    result.number.push_back(place.first);
  }
  return result;
}

/// Samples one path between two gear changes after the other.
class PathSampler {
 public:
  PathSampler(const DistinctLine& given, double spacing, const CancelToken& cancel)
      : line_(given.line), numbers_(given.number), spacing_(spacing), cancel_(cancel) {}

  /// The points from `first` to `last`, driven in one gear.
  void addLeg(std::size_t first, std::size_t last, Direction direction) {
    direction_ = direction;
    const std::vector<Tangents> tangents = tangentsOf(first, last);
    if (path_.empty()) add(line_.points[first], tangents.front().out, first, 0.0);
    for (std::size_t i = first; i < last; ++i) {
      const Tangents& from = tangents[i - first];
      const Tangents& to = tangents[i + 1 - first];
      addPiece(i, from.out, to.in);
      add(line_.points[i + 1], to.between(), i + 1, i + 1 < last ? to.corner() : 0.0);
    }
  }

  Path takePath() { return std::move(path_); }

  /// The stretches of `path` above the vehicle's curvature.
  std::vector<TightBend> tightBends(const Path& path, double max_kappa) const {
    std::vector<TightBend> bends;
    double worst = 0.0;  // curvature on the present stretch
    for (std::size_t i = 0; i < path.size(); ++i) {
      // Where the line turns back on itself, the points around the corner are the same, and show no curvature.
      const double kappa = std::max(std::abs(path[i].kappa), 0.5 * std::abs(corners_[i]) / spacing_);
      if (kappa <= max_kappa * kCurvatureTolerance) {
        worst = 0.0;
        continue;
      }
      if (worst == 0.0) bends.emplace_back();
      if (kappa > worst) bends.back() = {numbers_[waypoints_[i]], path[i].pose().position(), 1.0 / kappa, corners_[i]};
      worst = std::max(worst, kappa);
    }
    return bends;
  }

 private:
  std::optional<double> wantedDirection(std::size_t i) const {
    if (line_.headings.empty()) return i + 1 == line_.points.size() ? line_.end_heading : std::nullopt;
    return line_.headings[i] + (direction_ == Direction::kForward ? 0.0 : M_PI);
  }

  std::vector<Tangents> tangentsOf(std::size_t first, std::size_t last) const {
    const std::vector<Point2d>& points = line_.points;
    std::vector<Tangents> tangents(last - first + 1);
    for (std::size_t i = first + 1; i < last; ++i) {
      tangents[i - first] = tangentsAt(points[i - 1], points[i], points[i + 1], wantedDirection(i));
    }
    const Point2d first_chord = points[first + 1] - points[first], last_chord = points[last] - points[last - 1];
    // A single chord has no neighbour to bend towards.
    const double next = last > first + 1 ? tangents[1].in : headingOf(first_chord);
    const double begin = tangentAtEnd(first_chord, next, wantedDirection(first));
    const double previous = last > first + 1 ? tangents[last - first - 1].out : begin;
    const double end = tangentAtEnd(last_chord, previous, wantedDirection(last));
    tangents.front() = {begin, begin};
    tangents.back() = {end, end};
    return tangents;
  }

  /// What lies between the points `i` and `i + 1`.
  void addPiece(std::size_t i, double begin, double end) {
    const Point2d &from = line_.points[i], &to = line_.points[i + 1];
    const Point2d chord = to - from;
    const double along = headingOf(chord);
    const double turn = std::abs(angleBetween(along, begin)) + std::abs(angleBetween(along, end));
    // With this length of its end tangents the cubic is closest to an arc.
    const double reach = chord.norm() / std::pow(std::cos(turn / 4.0), 2.0);
    const Point2d tangent0 = reach * unitVector(begin), tangent1 = reach * unitVector(end);
    const int parts = std::max(1, static_cast<int>(std::ceil(reach / spacing_ - 1e-6)));
    for (int k = 1; k < parts; ++k) {
      const double u = static_cast<double>(k) / parts;
      const double bend = u * u * (3.0 - 2.0 * u);
      const Point2d position =
          from + bend * chord + u * (1.0 - u) * (1.0 - u) * tangent0 - u * u * (1.0 - u) * tangent1;
      const Point2d derivative =
          6.0 * u * (1.0 - u) * chord + (1.0 - u) * (1.0 - 3.0 * u) * tangent0 + u * (3.0 * u - 2.0) * tangent1;
      add(position, headingOf(derivative), u < 0.5 ? i : i + 1, 0.0);
    }
  }

  void add(const Point2d& position, double motion, std::size_t waypoint, double corner) {
    if (path_.size() % kPollInterval == 0) cancel_.throwIfCancelled();
    ReferencePoint point;
    point.x = position.x();
    point.y = position.y();
    point.heading = normalizeAngle(motion + (direction_ == Direction::kForward ? 0.0 : M_PI));
    point.direction = direction_;
    path_.push_back(point);
    waypoints_.push_back(waypoint);
    corners_.push_back(corner);
  }

  const WaypointLine& line_;
  const std::vector<std::size_t>& numbers_;
  const double spacing_;
  const CancelToken& cancel_;
  Direction direction_ = Direction::kForward;
  Path path_;
  std::vector<std::size_t> waypoints_;  ///< per path point: the nearest one
  std::vector<double> corners_;         ///< per path point: its turn on the spot [rad]
};

void requirePoints(const DistinctLine& given, std::size_t count_given, double spacing, const PathBounds& bounds) {
  const std::vector<Point2d>& points = given.line.points;
  const auto name = [&](std::size_t i) { return text(given.line.names.point, "[", given.number[i], "]"); };
  double length = 0.0, count = 1.0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) throw InvalidRequest(name(i) + " is not finite");
    if (i == 0) continue;
    length += (points[i] - points[i - 1]).norm();
    count += std::ceil((points[i] - points[i - 1]).norm() / spacing);
  }
  bounds.require(length, count);
  if (points.size() >= 2) return;
  throw InvalidRequest(text(given.line.names.point, " has ", count_given, " points",
                            count_given > 1 ? ", all in one place" : "",
                            "; at least 2 in different places are needed"));
}

/// The gear from point `i` to the next.
Direction gearAfter(const DistinctLine& given, std::size_t i) {
  const WaypointLine& line = given.line;
  const double along = headingOf(line.points[i + 1] - line.points[i]);
  // On an arc the mean of both headings is the direction of its chord.
  const double turn = angleBetween(line.headings[i], line.headings[i + 1]);
  const double error = std::abs(angleBetween(along, line.headings[i] + 0.5 * turn));
  if (error <= kMaxHeadingError) return Direction::kForward;
  if (M_PI - error <= kMaxHeadingError) return Direction::kReverse;
  const std::size_t from = given.number[i], to = given.number[i + 1];
  const std::string &point = line.names.point, &heading = line.names.heading;
  throw InvalidRequest(text(heading, "[", from, "] ", radians(line.headings[i]), " and ", heading, "[", to, "] ",
                            radians(line.headings[i + 1]), " lie across the way from ", point, "[", from, "] ",
                            at(line.points[i]), " to ", point, "[", to, "] ", at(line.points[i + 1]),
                            ", whose direction is ", radians(along),
                            "; give headings along it, or against it to reverse"));
}

std::vector<Direction> gearsOf(const DistinctLine& given) {
  const WaypointLine& line = given.line;
  if (line.end_heading && !std::isfinite(*line.end_heading)) {
    throw InvalidRequest(line.names.end_heading + " is not finite");
  }
  std::vector<Direction> gears(line.points.size() - 1, Direction::kForward);
  if (line.headings.empty()) return gears;
  for (std::size_t i = 0; i < line.headings.size(); ++i) {
    if (!std::isfinite(line.headings[i])) {
      throw InvalidRequest(text(line.names.heading, "[", given.number[i], "] is not finite"));
    }
  }
  for (std::size_t i = 0; i < gears.size(); ++i) gears[i] = gearAfter(given, i);
  return gears;
}

WaypointPath sampled(const DistinctLine& given, const std::vector<Direction>& gears, const VehicleParams& vehicle,
                     double spacing, double speed, const CancelToken& cancel) {
  PathSampler sampler(given, spacing, cancel);
  for (std::size_t first = 0; first < gears.size();) {
    std::size_t last = first + 1;
    while (last < gears.size() && gears[last] == gears[first]) ++last;
    sampler.addLeg(first, last, gears[first]);
    first = last;
  }
  WaypointPath result;
  result.path = sampler.takePath();
  for (ReferencePoint& point : result.path) point.speed = speed;
  setArcLengths(&result.path);
  cancel.throwIfCancelled();
  setCurvatures(&result.path);
  cancel.throwIfCancelled();
  result.tight_bends = sampler.tightBends(result.path, vehicle.maxKappa());
  return result;
}

}  // namespace

std::vector<WaypointPlace> placesOf(const std::vector<Point2d>& points) {
  std::vector<WaypointPlace> places;
  for (std::size_t i = 0; i < points.size(); ++i) {
    // From the first of a place: many small steps in a row are a way.
    const bool is_repeated = i > 0 && (points[i] - points[places.back().first]).norm() < kRepeated;
    if (!is_repeated) places.push_back({i, i});
    places.back().last = i;
  }
  return places;
}

void checkWaypoints(const WaypointLine& line, double spacing, const PathBounds& bounds) {
  const DistinctLine given = distinct(line);
  requirePoints(given, line.points.size(), spacing, bounds);
  gearsOf(given);
}

WaypointPath pathThrough(const WaypointLine& line, const VehicleParams& vehicle, double spacing, double target_speed,
                         const PathBounds& bounds, const CancelToken& cancel) {
  DistinctLine given = distinct(line);
  requirePoints(given, line.points.size(), spacing, bounds);
  const std::vector<Direction> gears = gearsOf(given);
  const double speed = target_speed > 0.0 ? target_speed : vehicle.max_speed;
  const std::optional<double> wished = given.line.headings.empty() ? given.line.end_heading : std::nullopt;
  const auto remaining = [&](const WaypointPath& result) {
    return wished ? angleBetween(result.path.back().heading, *wished) : 0.0;
  };
  given.line.end_heading.reset();
  WaypointPath result = sampled(given, gears, vehicle, spacing, speed, cancel);
  result.end_turn = remaining(result);
  if (std::abs(result.end_turn) < kSameHeading) return result;
  given.line.end_heading = wished;
  WaypointPath turned = sampled(given, gears, vehicle, spacing, speed, cancel);
  turned.end_turn = remaining(turned);
  const bool is_drivable = turned.tight_bends.size() <= result.tight_bends.size();
  return is_drivable && std::abs(turned.end_turn) < kSameHeading ? turned : result;
}

}  // namespace external_command
