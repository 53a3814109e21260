// SPDX-License-Identifier: Apache-2.0
#include "lane_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace external_command {

namespace {

/// Rounding must not lose a lane that lies exactly at a limit.
constexpr double kTolerance = 1e-9;

/// A segment of a lane's centre line, and the squared distance to it [m^2].
struct NearSegment {
  LaneIndex lane = 0;
  std::size_t first = 0;  // point of the centre line
  double squared = std::numeric_limits<double>::infinity();
};

double headingOfSegment(const std::vector<Point2d>& line, std::size_t first) {
  return headingOf(line[first + 1] - line[first]);
}

bool fits(const LaneQuery& query, const std::vector<Point2d>& line, std::size_t first) {
  if (!query.heading) return true;
  const double difference = std::abs(angleBetween(*query.heading, headingOfSegment(line, first)));
  return difference <= query.max_heading_difference + kTolerance;  // false for NaN
}

/// The nearest segment of the piece that has a fitting heading.
NearSegment nearestOf(const std::vector<Point2d>& line, const LanePiece& piece, const Point2d& point,
                      const LaneQuery& query) {
  NearSegment nearest{piece.lane};
  for (std::size_t i = piece.first; i < piece.last; ++i) {
    const double squared = (point - nearestOnSegment(point, line[i], line[i + 1])).squaredNorm();
    if (squared < nearest.squared && fits(query, line, i)) nearest = {piece.lane, i, squared};
  }
  return nearest;
}

LaneMatch matchOf(const MapContent& map, const NearSegment& segment, const Point2d& point) {
  const Polyline& center = map.lanes[segment.lane].center;
  const Point2d &begin = center.points()[segment.first], &end = center.points()[segment.first + 1];
  const Point2d foot = nearestOnSegment(point, begin, end);
  const FrenetPoint frenet{center.arcLengths()[segment.first] + (foot - begin).norm(),
                           cross((end - begin).normalized(), point - foot), std::sqrt(segment.squared)};
  return {segment.lane, frenet, headingOfSegment(center.points(), segment.first)};
}

/// One match for each stretch of the lane that lies within `bound` [m^2] and has a fitting heading.
void addMatches(const MapContent& map, LaneIndex lane, const Point2d& point, const LaneQuery& query, double bound,
                std::vector<LaneMatch>* matches) {
  const std::vector<Point2d>& line = map.lanes[lane].center.points();
  NearSegment nearest;
  const auto end_stretch = [&] {
    if (std::isfinite(nearest.squared)) matches->push_back(matchOf(map, nearest, point));
    nearest = {};
  };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double squared = (point - nearestOnSegment(point, line[i], line[i + 1])).squaredNorm();
    if (!(squared <= bound && fits(query, line, i))) {
      end_stretch();
    } else if (squared < nearest.squared) {
      nearest = {lane, i, squared};
    }
  }
  end_stretch();
}

bool isNearer(const LaneMatch& a, const LaneMatch& b) {
  return std::tuple(a.frenet.distance, a.lane, a.frenet.s) < std::tuple(b.frenet.distance, b.lane, b.frenet.s);
}

/// Squared radius of the search [m^2]; negative where nothing can match.
double searchBound(const Point2d& point, const LaneQuery& query) {
  if (!point.allFinite() || !(query.max_distance >= 0.0)) return -1.0;
  const double reach = query.max_distance + kTolerance;
  return reach * reach;
}

/// Calls `visit(segment, bound)` for the nearest segment of every piece of a lane within the bound.
template <class Visit>
void visitLanes(const MapContent& map, const Point2d& point, const LaneQuery& query, const Visit& visit) {
  map.tree.visitNear(point, searchBound(point, query), [&](const LanePiece& piece, double bound) {
    const Lane& lane = map.lanes[piece.lane];
    if (query.drivable_only && !lane.isDrivable()) return bound;
    const NearSegment nearest = nearestOf(lane.center.points(), piece, point, query);
    return nearest.squared <= bound ? visit(nearest, bound) : bound;
  });
}

}  // namespace

std::optional<LaneMatch> nearestLane(const MapContent& map, const Point2d& point, const LaneQuery& query) {
  std::optional<NearSegment> best;
  visitLanes(map, point, query, [&](const NearSegment& segment, double bound) {
    const bool is_later = best && segment.squared == best->squared &&
                          std::pair(segment.lane, segment.first) > std::pair(best->lane, best->first);
    if (is_later) return bound;
    best = segment;
    return segment.squared;
  });
  if (!best) return std::nullopt;
  return matchOf(map, *best, point);
}

std::vector<LaneMatch> lanesWithin(const MapContent& map, const Point2d& point, const LaneQuery& query) {
  std::vector<LaneIndex> near;
  visitLanes(map, point, query, [&](const NearSegment& segment, double bound) {
    near.push_back(segment.lane);
    return bound;
  });
  return matchesOf(map, std::move(near), point, query);
}

std::vector<LaneMatch> matchesOf(const MapContent& map, std::vector<LaneIndex> lanes, const Point2d& point,
                                 const LaneQuery& query) {
  std::sort(lanes.begin(), lanes.end());
  lanes.erase(std::unique(lanes.begin(), lanes.end()), lanes.end());
  std::vector<LaneMatch> matches;
  for (const LaneIndex lane : lanes) addMatches(map, lane, point, query, searchBound(point, query), &matches);
  std::sort(matches.begin(), matches.end(), isNearer);
  return matches;
}

}  // namespace external_command
