// SPDX-License-Identifier: Apache-2.0
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstdint>
#include <unordered_set>
#include <utility>

#include "checks.h"
#include "core/boost_point.h"
#include "map/lane_search.h"

namespace external_command {

namespace {

constexpr double kTouch = 0.3;       // [m]; ends this near are drawn as one
constexpr double kSameWay = 0.5;     // [rad]
constexpr double kHeightJump = 0.5;  // [m]

namespace bg = boost::geometry;
namespace bgi = boost::geometry::index;
using Begin = std::pair<Point2d, LaneIndex>;
using BeginTree = bgi::rtree<Begin, bgi::rstar<16>>;

std::uint64_t linkOf(LaneIndex from, LaneIndex onto) { return std::uint64_t{from} << 32 | onto; }

class Joints {
 public:
  explicit Joints(const MapUnderCheck& check) : check_(check), map_(check.map) {
    std::vector<Begin> begins;
    for (LaneIndex index = 0; index < map_.lanes().size(); ++index) {
      const Lane& lane = map_.lane(index);
      for (const LaneIndex next : lane.successors) links_.insert(linkOf(index, next));
      if (lane.isDrivable()) begins.emplace_back(lane.center.points().front(), index);
    }
    for (const BrokenLink& link : map_.brokenLinks()) links_.insert(linkOf(link.from, link.onto));
    begins_ = BeginTree(begins);
  }

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
    for (const LaneMatch& match : matchesOf(map_.content(), unlinkedFrom(index), end, query)) {
      const Lane& next = map_.lane(match.lane);
      if (areApart(lane, next)) continue;
      const double distance = (next.center.points().front() - end).norm();
      check_.faults->add(MapFault::kLinkMissing, {lane.id, next.id}, {end}, lane.id, " ends where ", next.id,
                         " begins, ", metres(distance), " apart");
    }
  }

  /// Driving lanes that begin where this one ends, without a link.
  std::vector<LaneIndex> unlinkedFrom(LaneIndex index) const {
    const Point2d end = map_.lane(index).center.points().back();
    const Point2d reach = Point2d::Constant(kTouch);
    const auto is_meant = [&](const Begin& begin) {
      return begin.second != index && (begin.first - end).norm() <= kTouch &&
             links_.count(linkOf(index, begin.second)) == 0;
    };
    const bg::model::box<Point2d> around(end - reach, end + reach);
    std::vector<LaneIndex> lanes;
    for (auto found = begins_.qbegin(bgi::intersects(around) && bgi::satisfies(is_meant)); found != begins_.qend();
         ++found) {
      lanes.push_back(found->second);
    }
    return lanes;
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
  std::unordered_set<std::uint64_t> links_;  // as linkOf() has them, driven or broken
  BeginTree begins_;                         // of driving lanes
};

}  // namespace

void checkJoints(const MapUnderCheck& check) { Joints(check).run(); }

}  // namespace external_command
