// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "lane_blocks.h"
#include "lane_checks.h"

namespace external_command {

namespace {

constexpr double kMeet = 0.05;        // [m]; ends no further apart meet
constexpr double kOddGap = 0.3;       // [m]; what is less is the drawing's precision
constexpr double kMaxOverlap = 20.0;  // [m]
constexpr double kOnLane = 1.0;       // [m] between two lanes that overlap
constexpr double kKink = 1.0;         // [rad]
constexpr double kFoldTurn = 2.1;     // [rad]
constexpr double kOddFold = 0.1;      // [m]

double startHeading(const Polyline& line) { return headingOf(line.points()[1] - line.points()[0]); }

double endHeading(const Polyline& line) {
  const std::vector<Point2d>& points = line.points();
  return headingOf(points.back() - points[points.size() - 2]);
}

/// How one lane goes over into the next.
struct Joint {
  double gap = 0.0;    // from the end of the one to where the next is entered [m]
  double entry = 0.0;  // where on the next lane that is; above 0 where it begins before the other ends [m]
  double turn = 0.0;   // of the heading [rad]
};

Joint jointOf(const Polyline& from, const Polyline& onto) {
  const Point2d end = from.points().back();
  const double gap = (onto.points().front() - end).norm();
  Joint joint{gap, 0.0, std::abs(angleBetween(endHeading(from), startHeading(onto)))};
  if (gap <= kMeet) return joint;
  const FrenetPoint foot = onto.project(end);
  const double turn = std::abs(angleBetween(endHeading(from), onto.headingAt(foot.s)));
  const bool overlaps = foot.s > kMeet && foot.s <= kMaxOverlap && foot.s < onto.length() - kMeet &&
                        foot.distance <= std::min(kOnLane, gap) && turn < M_PI / 2.0;
  return overlaps ? Joint{foot.distance, foot.s, turn} : joint;
}

void checkFolds(const Lane& lane, MapFaults* faults) {
  const std::vector<Point2d>& line = lane.center.points();
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    const Point2d in = line[i] - line[i - 1], out = line[i + 1] - line[i];
    if (in.dot(out) > 0.0) continue;  // nearly all; a right angle is not enough
    const double back = std::min(in.norm(), out.norm());
    if (back < kOddFold || std::abs(angleBetween(headingOf(in), headingOf(out))) < kFoldTurn) continue;
    faults->add(MapFault::kFold, {lane.id}, {line[i], back}, lane.id, " at ", at(line[i]), ", by ", metres(back));
  }
}

class LinkCheck {
 public:
  LinkCheck(double max_gap, MapContent* map) : max_gap_(max_gap), map_(*map), joints_(map->lanes.size()) {}

  void run() {
    inBlocks(map_.lanes.size(), &map_.faults, [this](std::size_t begin, std::size_t end, MapFaults* faults) {
      for (std::size_t i = begin; i < end; ++i) measure(i, faults);
    });
    for (std::size_t i = 0; i < map_.lanes.size(); ++i) checkLinksOf(static_cast<LaneIndex>(i));
  }

 private:
  void measure(std::size_t index, MapFaults* faults) {
    const Lane& lane = map_.lanes[index];
    joints_[index].reserve(lane.successors.size());
    for (const LaneIndex next : lane.successors) {
      joints_[index].push_back(jointOf(lane.center, map_.lanes[next].center));
    }
    if (!lane.is_reversed) checkFolds(lane, faults);
  }

  void checkLinksOf(LaneIndex index) {
    Lane& lane = map_.lanes[index];
    std::vector<LaneIndex> kept;
    for (std::size_t i = 0; i < lane.successors.size(); ++i) {
      const LaneIndex next = lane.successors[i];
      const Lane& onto = map_.lanes[next];
      const Joint& joint = joints_[index][i];
      const bool is_driven = lane.isDrivable() && onto.isDrivable();
      if (is_driven && joint.gap > max_gap_) {
        drop(index, next, joint.gap);
        continue;
      }
      kept.push_back(next);
      lane.entries.push_back(joint.entry);
      if (is_driven) count(lane, onto, joint);
    }
    lane.successors = std::move(kept);
  }

  void drop(LaneIndex from, LaneIndex onto, double gap) {
    // A lane of both directions may be meant the other way.
    const auto leads = [this](LaneIndex a, LaneIndex b) {
      const std::vector<LaneIndex>& next = map_.lanes[a].successors;
      return std::find(next.begin(), next.end(), b) != next.end();
    };
    const Lane &lane = map_.lanes[from], &next = map_.lanes[onto];
    if (lane.reverse && (leads(*lane.reverse, onto) || leads(onto, *lane.reverse))) return;
    if (next.reverse && (leads(from, *next.reverse) || leads(*next.reverse, from))) return;
    map_.faults.add(MapFault::kLinkBroken, {lane.id, next.id}, {lane.center.points().back(), gap}, lane.id, " to ",
                    next.id, ", ", metres(gap));
    map_.broken_links.push_back({from, onto, gap});
  }

  void count(const Lane& lane, const Lane& next, const Joint& joint) {
    const Point2d end = lane.center.points().back();
    if (joint.gap > kOddGap) {
      map_.faults.add(MapFault::kLinkGap, {lane.id, next.id}, {end, joint.gap}, lane.id, " to ", next.id, ", ",
                      metres(joint.gap));
    }
    if (joint.entry > kOddGap) {
      map_.faults.add(MapFault::kLinkOverlap, {lane.id, next.id}, {end, joint.entry}, lane.id, " and ", next.id,
                      ", by ", metres(joint.entry));
    }
    if (joint.turn > kKink) {
      map_.faults.add(MapFault::kLinkKink, {lane.id, next.id}, {end, joint.turn}, lane.id, " to ", next.id, ", by ",
                      radians(joint.turn));
    }
  }

  const double max_gap_;
  MapContent& map_;
  std::vector<std::vector<Joint>> joints_;  ///< of each lane with its successors
};

}  // namespace

void checkLinks(double max_gap, MapContent* map) { LinkCheck(max_gap, map).run(); }

}  // namespace external_command
