// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>

#include "lane_checks.h"

namespace external_command {

namespace {

using Links = std::vector<LaneIndex>;

double lengthOf(const std::vector<Point2d>& points) {
  double length = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length += (points[i] - points[i - 1]).norm();
  return length;
}

LaneBoundary reversed(LaneBoundary boundary, double lane_length) {
  const double length = boundary.points.size() > 1 ? lengthOf(boundary.points) : lane_length;
  std::reverse(boundary.points.begin(), boundary.points.end());
  // Each type goes up to where the next one begins, which is where it begins now.
  std::vector<BoundaryTypeChange> types;
  double begin = 0.0;
  for (auto type = boundary.types.rbegin(); type != boundary.types.rend(); ++type) {
    types.push_back({begin, type->type});
    begin = std::max(0.0, length - type->s);
  }
  boundary.types = std::move(types);
  return boundary;
}

template <class Sample>
std::vector<Sample> reversed(std::vector<Sample> samples, double length) {
  std::reverse(samples.begin(), samples.end());
  for (Sample& sample : samples) sample.s = std::max(0.0, length - sample.s);
  return samples;
}

LaneTurn reversed(LaneTurn turn) {
  if (turn == LaneTurn::kLeft) return LaneTurn::kRight;
  return turn == LaneTurn::kRight ? LaneTurn::kLeft : turn;
}

void addOnce(LaneIndex lane, Links* links) {
  if (std::find(links->begin(), links->end(), lane) == links->end()) links->push_back(lane);
}

bool contains(const Links& links, LaneIndex lane) { return std::find(links.begin(), links.end(), lane) != links.end(); }

/// The lane driven the other way, with neither links nor neighbours.
Lane reversed(const Lane& lane) {
  std::vector<Point2d> line = lane.center.points();
  std::reverse(line.begin(), line.end());
  Lane other{lane};
  other.center = Polyline(std::move(line));
  other.left = reversed(lane.right, lane.length());
  other.right = reversed(lane.left, lane.length());
  other.left_widths = reversed(lane.right_widths, lane.length());
  other.right_widths = reversed(lane.left_widths, lane.length());
  other.heights = reversed(lane.heights, lane.length());
  other.turn = reversed(lane.turn);
  for (Links* links : {&other.predecessors, &other.successors, &other.left_forward, &other.right_forward,
                       &other.left_reverse, &other.right_reverse}) {
    links->clear();
  }
  other.is_reversed = true;
  return other;
}

class ReverseLanes {
 public:
  ReverseLanes(double max_gap, MapContent* map) : max_gap_(max_gap), map_(*map) {}

  void run() {
    const std::size_t count = map_.lanes.size();
    for (std::size_t i = 0; i < count; ++i) {
      if (map_.lanes[i].direction != LaneDirection::kBidirection || !map_.lanes[i].isDrivable()) continue;
      map_.lanes.push_back(reversed(map_.lanes[i]));
      map_.lanes[i].reverse = static_cast<LaneIndex>(map_.lanes.size() - 1);
      map_.lanes.back().reverse = static_cast<LaneIndex>(i);
    }
    if (map_.lanes.size() == count) return;
    findLinked(count);
    for (std::size_t i = count; i < map_.lanes.size(); ++i) {
      const LaneIndex forward = *map_.lanes[i].reverse;
      for (const LaneIndex other : linked_[forward]) link(static_cast<LaneIndex>(i), other);
      setNeighbours(static_cast<LaneIndex>(i), map_.lanes[forward]);
    }
  }

 private:
  /// Which lanes the file links with each, in whichever direction.
  void findLinked(std::size_t count) {
    linked_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      for (const Links* links : {&map_.lanes[i].predecessors, &map_.lanes[i].successors}) {
        for (const LaneIndex other : *links) {
          addOnce(other, &linked_[i]);
          addOnce(static_cast<LaneIndex>(i), &linked_[other]);
        }
      }
    }
  }

  /// Links a reversed lane with both directions of another, where their ends meet.
  void link(LaneIndex reversed_lane, LaneIndex other) {
    for (const LaneIndex next : {other, map_.lanes[other].reverse.value_or(other)}) {
      if (leads(reversed_lane, next)) connect(reversed_lane, next);
      if (leads(next, reversed_lane)) connect(next, reversed_lane);
    }
  }

  bool leads(LaneIndex from, LaneIndex onto) const {
    const Polyline &a = map_.lanes[from].center, &b = map_.lanes[onto].center;
    if ((a.points().back() - b.points().front()).norm() > max_gap_) return false;
    return std::abs(angleBetween(a.headingAt(a.length()), b.headingAt(0.0))) < M_PI / 2.0;
  }

  void connect(LaneIndex from, LaneIndex onto) {
    addOnce(onto, &map_.lanes[from].successors);
    addOnce(from, &map_.lanes[onto].predecessors);
  }

  /// What runs against a lane runs with its other direction.
  void setNeighbours(LaneIndex index, const Lane& forward) {
    Lane& lane = map_.lanes[index];
    lane.left_forward = forward.right_reverse;
    lane.right_forward = forward.left_reverse;
    lane.left_reverse = forward.right_forward;
    lane.right_reverse = forward.left_forward;
    for (const LaneIndex other : lane.left_forward) standBeside(index, *lane.reverse, &map_.lanes[other]);
    for (const LaneIndex other : lane.right_forward) standBeside(index, *lane.reverse, &map_.lanes[other]);
    for (const LaneIndex other : forward.left_forward) {
      if (map_.lanes[other].reverse) addOnce(*map_.lanes[other].reverse, &lane.right_forward);
    }
    for (const LaneIndex other : forward.right_forward) {
      if (map_.lanes[other].reverse) addOnce(*map_.lanes[other].reverse, &lane.left_forward);
    }
  }

  static void standBeside(LaneIndex reversed_lane, LaneIndex forward, Lane* other) {
    if (contains(other->left_reverse, forward)) addOnce(reversed_lane, &other->left_forward);
    if (contains(other->right_reverse, forward)) addOnce(reversed_lane, &other->right_forward);
  }

  const double max_gap_;
  MapContent& map_;
  std::vector<Links> linked_;
};

}  // namespace

void addReverseLanes(double max_gap, MapContent* map) { ReverseLanes(max_gap, map).run(); }

}  // namespace external_command
