// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "checks.h"

namespace external_command {

namespace {

constexpr double kTouch = 0.3;       // [m]; ends this near are drawn as one
constexpr double kSameWay = 0.5;     // [rad]
constexpr double kHeightJump = 0.5;  // [m]

bool contains(const std::vector<LaneIndex>& lanes, LaneIndex lane) {
  return std::find(lanes.begin(), lanes.end(), lane) != lanes.end();
}

class Joints {
 public:
  explicit Joints(const MapUnderCheck& check) : check_(check), map_(check.map) {}

  void run() {
    for (LaneIndex index = 0; index < map_.lanes().size(); ++index) {
      const Lane& lane = map_.lane(index);
      if (!lane.isDrivable() || lane.is_reversed) continue;
      checkEnd(index);
      for (const LaneIndex next : lane.successors) checkHeights(lane, map_.lane(next));
    }
  }

 private:
  /// A lane that leads nowhere, though others begin just there.
  void checkEnd(LaneIndex index) {
    const Lane& lane = map_.lane(index);
    LaneQuery query;
    query.max_distance = kTouch;
    query.heading = lane.center.headingAt(lane.length());
    query.max_heading_difference = kSameWay;
    const Point2d end = lane.center.points().back();
    for (const LaneMatch& match : map_.lanesWithin(end, query)) {
      const Lane& next = map_.lane(match.lane);
      const double distance = (next.center.points().front() - end).norm();
      if (match.lane == index || distance > kTouch || contains(lane.successors, match.lane)) continue;
      if (isBroken(index, match.lane) || areApart(lane, next)) continue;
      check_.faults->add(MapFault::kLinkMissing, {lane.id, next.id}, {end}, lane.id, " ends where ", next.id,
                         " begins, ", metres(distance), " apart");
    }
  }

  bool isBroken(LaneIndex from, LaneIndex onto) const {
    const std::vector<BrokenLink>& broken = map_.brokenLinks();
    return std::any_of(broken.begin(), broken.end(),
                       [&](const BrokenLink& link) { return link.from == from && link.onto == onto; });
  }

  /// One above the other.
  static bool areApart(const Lane& lane, const Lane& next) {
    const auto jump = heightJump(lane, next);
    return jump && *jump > kHeightJump;
  }

  static std::optional<double> heightJump(const Lane& lane, const Lane& next) {
    const auto end = lane.heightAt(lane.length()), begin = next.heightAt(0.0);
    if (!end || !begin) return std::nullopt;
    return std::abs(*end - *begin);
  }

  void checkHeights(const Lane& lane, const Lane& next) {
    const auto jump = heightJump(lane, next);
    if (!next.isDrivable() || !jump || *jump <= kHeightJump) return;
    check_.faults->add(MapFault::kLinkHeightJump, {lane.id, next.id}, {lane.center.points().back(), *jump}, lane.id,
                       " to ", next.id, ", by ", metres(*jump));
  }

  const MapUnderCheck& check_;
  const HdMap& map_;
};

}  // namespace

void checkJoints(const MapUnderCheck& check) { Joints(check).run(); }

}  // namespace external_command
