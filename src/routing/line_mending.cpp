// SPDX-License-Identifier: Apache-2.0
#include "line_mending.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kMeeting = 0.05;     // ends this near to each other meet [m]
constexpr double kBeside = 0.1;       // and this far to the side lie beside each other [m]
constexpr double kSlant = 4.0;        // metres along for a metre to the side
constexpr double kShare = 0.5;        // of a lane that may be cut
constexpr double kRepeated = 1e-3;    // [m]
constexpr double kLongestFold = 10;   // [m]
constexpr double kTurnedBack = -0.5;  // cosine of a turn on the spot: more than 120 degrees
constexpr double kSameWay = 0.5;      // cosine between directions that go on
constexpr double kLookBack = 0.3;     // over which a direction is taken, where points lie close [m]

/// The direction in which the line arrives at its point kept.back(), of length 1.
Point2d arrivalAt(const std::vector<Point2d>& points, const std::vector<std::size_t>& kept) {
  const Point2d& here = points[kept.back()];
  std::size_t k = kept.size() - 1;
  while (k > 0 && (here - points[kept[k]]).norm() < kLookBack) --k;
  const Point2d way = here - points[kept[k]];
  return way.norm() > kRepeated ? Point2d(way.normalized()) : Point2d(0.0, 0.0);
}

/// The first point from `first` on, within the longest fold, from which the line goes on along `way` again; `count` of
/// points where there is none.
std::size_t endOfFold(const std::vector<Point2d>& points, std::size_t first, const Point2d& way) {
  double length = 0.0;
  for (std::size_t j = first; j + 1 < points.size() && length <= kLongestFold; ++j) {
    const Point2d next = points[j + 1] - points[j];
    if (next.norm() > kRepeated && next.normalized().dot(way) > kSameWay) return j;
    length += next.norm();
  }
  return points.size();
}

void dropAhead(const std::vector<Point2d>& points, const Point2d& place, const Point2d& way,
               std::vector<std::size_t>* kept) {
  double length = 0.0;
  while (kept->size() > 1 && (points[kept->back()] - place).dot(way) > -kRepeated && length <= kLongestFold) {
    length += (points[kept->back()] - points[(*kept)[kept->size() - 2]]).norm();
    kept->pop_back();
  }
}

}  // namespace

void joinEnds(const HdMap& map, std::vector<LaneRange>* pieces) {
  for (std::size_t k = 0; k + 1 < pieces->size(); ++k) {
    LaneRange &last = (*pieces)[k], &next = (*pieces)[k + 1];
    const Polyline &from = map.lane(last.lane).center, &to = map.lane(next.lane).center;
    const Point2d gap = to.pointAt(next.from_s) - from.pointAt(last.to_s);
    if (gap.norm() < kMeeting) continue;
    const Point2d way = unitVector(from.headingAt(last.to_s - kRepeated));
    const double along = gap.dot(way), beside = std::abs(cross(way, gap));
    const double slant = beside > kBeside ? std::max(0.0, 0.5 * (kSlant * beside - std::max(0.0, along))) : 0.0;
    const double overlap = std::max(0.0, -along);
    last.to_s -= std::min(overlap + slant, kShare * (last.to_s - last.from_s));
    next.from_s += std::min(slant, kShare * (next.to_s - next.from_s));
  }
}

std::vector<std::size_t> withoutFolds(const std::vector<Point2d>& points) {
  std::vector<std::size_t> kept = {0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point2d step = points[i] - points[kept.back()];
    const double length = step.norm();
    const bool is_last = i + 1 == points.size();
    if (length < kRepeated) {
      if (is_last && kept.size() > 1) kept.back() = i;
      if (is_last && kept.size() == 1) kept.push_back(i);
      continue;
    }
    const Point2d way = kept.size() > 1 ? arrivalAt(points, kept) : Point2d(0.0, 0.0);
    if (step.dot(way) < kTurnedBack * length) {
      const std::size_t end = endOfFold(points, i, way);
      if (end < points.size()) {
        dropAhead(points, points[end], way, &kept);
        i = end;
      }
    }
    kept.push_back(i);
  }
  return kept;
}

}  // namespace external_command
