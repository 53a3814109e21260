// SPDX-License-Identifier: Apache-2.0
#include "lane_pair.h"

#include <algorithm>

namespace external_command {

namespace {

constexpr double kSameEnd = 6.0;       // [m]; a wide lane, and its end cut askew
constexpr double kWholeShare = 0.75;   // of a lane, from which on it counts as beside in all its length
constexpr double kMinStretch = 0.001;  // [m]

bool mayBeCrossed(BoundaryType type) {
  return type == BoundaryType::kUnknown || type == BoundaryType::kDottedYellow || type == BoundaryType::kDottedWhite;
}

bool beginAndEndTogether(const Polyline& a, const Polyline& b) {
  return (a.points().front() - b.points().front()).norm() < kSameEnd &&
         (a.points().back() - b.points().back()).norm() < kSameEnd;
}

double lengthOf(const std::vector<Point2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

/// Where the boundary may be crossed, as shares of its length.
std::vector<Interval> crossableShares(const LaneBoundary& boundary, double lane_length) {
  if (boundary.is_virtual || boundary.types.empty()) return {{0.0, 1.0}};
  const double drawn = lengthOf(boundary.points);
  const double length = drawn > kMinStretch ? drawn : lane_length;
  std::vector<Interval> shares;
  for (std::size_t i = 0; i < boundary.types.size(); ++i) {
    if (!mayBeCrossed(boundary.types[i].type)) continue;
    const bool is_last = i + 1 == boundary.types.size();
    const double from = i == 0 ? 0.0 : std::min(boundary.types[i].s / length, 1.0);
    const double to = is_last ? 1.0 : std::min(boundary.types[i + 1].s / length, 1.0);
    if (!shares.empty() && shares.back().to == from) {
      shares.back().to = to;
    } else {
      shares.push_back({from, to});
    }
  }
  return shares;
}

}  // namespace

std::optional<LanePair> pairOf(const HdMap& map, LaneIndex a, LaneIndex b, LaneChange side) {
  const Polyline &center_a = map.lane(a).center, &center_b = map.lane(b).center;
  LanePair pair{b, side, 0.0, center_a.length(), 0.0, center_b.length()};
  if (!beginAndEndTogether(center_a, center_b)) {
    const Interval on_a{center_a.project(center_b.points().front()).s, center_a.project(center_b.points().back()).s};
    const Interval on_b{center_b.project(center_a.points().front()).s, center_b.project(center_a.points().back()).s};
    if (on_a.to - on_a.from < kMinStretch || on_b.to - on_b.from < kMinStretch) return std::nullopt;
    const bool whole =
        on_a.to - on_a.from > kWholeShare * center_a.length() && on_b.to - on_b.from > kWholeShare * center_b.length();
    if (!whole) pair = {b, side, on_a.from, on_a.to, on_b.from, on_b.to};
  }
  return pair;
}

std::vector<Interval> crossableParts(const HdMap& map, LaneIndex a, const LanePair& pair) {
  const bool to_left = pair.side == LaneChange::kLeft;
  const Lane &lane_a = map.lane(a), &lane_b = map.lane(pair.b);
  const LaneBoundary& own = to_left ? lane_a.left : lane_a.right;
  const LaneBoundary& others = to_left ? lane_b.right : lane_b.left;
  const bool ask_other = own.types.empty() && !own.is_virtual;
  std::vector<Interval> parts;
  for (const Interval& share : crossableShares(ask_other ? others : own, lane_a.length())) {
    Interval part{share.from * lane_a.length(), share.to * lane_a.length()};
    if (ask_other) part = {pair.toA(share.from * lane_b.length()), pair.toA(share.to * lane_b.length())};
    part = {std::max(part.from, pair.a_from), std::min(part.to, pair.a_to)};
    if (part.to - part.from > kMinStretch) parts.push_back(part);
  }
  return parts;
}

}  // namespace external_command
