// SPDX-License-Identifier: Apache-2.0
#include "lane_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

namespace external_command {

namespace {

/// Rounding must not lose a lane that lies exactly at a limit.
constexpr double kTolerance = 1e-9;

double squaredDistance(const Point2d& point, const std::vector<Point2d>& line, const LanePiece& piece) {
  double squared = std::numeric_limits<double>::infinity();
  for (std::size_t i = piece.first; i < piece.last; ++i) {
    squared = std::min(squared, (point - nearestOnSegment(point, line[i], line[i + 1])).squaredNorm());
  }
  return squared;
}

/// nullopt where the lane's heading does not satisfy `query`.
std::optional<LaneMatch> match(const MapContent& map, LaneIndex index, const Point2d& point, const LaneQuery& query) {
  const Polyline& center = map.lanes[index].center;
  const FrenetPoint frenet = center.project(point);
  const double heading = center.headingAt(frenet.s);
  if (query.heading) {
    const double difference = std::abs(angleBetween(*query.heading, heading));
    if (!(difference <= query.max_heading_difference + kTolerance)) return std::nullopt;
  }
  return LaneMatch{index, frenet, heading};
}

bool isNearer(const LaneMatch& a, const LaneMatch& b) {
  return a.frenet.distance != b.frenet.distance ? a.frenet.distance < b.frenet.distance : a.lane < b.lane;
}

/// Squared radius of the search [m^2]; negative where nothing can match.
double searchBound(const Point2d& point, const LaneQuery& query) {
  if (!point.allFinite() || !(query.max_distance >= 0.0)) return -1.0;
  const double reach = query.max_distance + kTolerance;
  return reach * reach;
}

/// Calls `visit(lane, squared_distance, bound)` for every piece of a lane within the bound.
template <class Visit>
void visitLanes(const MapContent& map, const Point2d& point, const LaneQuery& query, const Visit& visit) {
  map.tree.visitNear(point, searchBound(point, query), [&](const LanePiece& piece, double bound) {
    const Lane& lane = map.lanes[piece.lane];
    if (query.drivable_only && !lane.isDrivable()) return bound;
    const double squared = squaredDistance(point, lane.center.points(), piece);
    return squared <= bound ? visit(piece.lane, squared, bound) : bound;
  });
}

}  // namespace

std::optional<LaneMatch> nearestLane(const MapContent& map, const Point2d& point, const LaneQuery& query) {
  std::optional<LaneIndex> best;
  std::unordered_set<LaneIndex> refused;
  visitLanes(map, point, query, [&](LaneIndex lane, double squared, double bound) {
    if (best && (lane == *best || (squared == bound && lane > *best))) return squared;
    if (query.heading) {
      // The whole lane has the word: a piece of it may lie in the right direction where the foot point does not.
      if (refused.count(lane) > 0) return bound;
      if (!match(map, lane, point, query)) {
        refused.insert(lane);
        return bound;
      }
    }
    best = lane;
    return squared;
  });
  return best ? match(map, *best, point, query) : std::nullopt;
}

std::vector<LaneMatch> lanesWithin(const MapContent& map, const Point2d& point, const LaneQuery& query) {
  std::vector<LaneIndex> near;
  visitLanes(map, point, query, [&](LaneIndex lane, double, double bound) {
    near.push_back(lane);
    return bound;
  });
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  std::vector<LaneMatch> matches;
  for (const LaneIndex lane : near) {
    if (const auto candidate = match(map, lane, point, query)) matches.push_back(*candidate);
  }
  std::sort(matches.begin(), matches.end(), isNearer);
  return matches;
}

}  // namespace external_command
