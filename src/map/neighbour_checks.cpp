// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "lane_blocks.h"
#include "lane_checks.h"
#include "lane_search.h"

namespace external_command {

namespace {

constexpr double kClearlyBeside = 0.5;  // [m]; what lies nearer to the centre line lies on neither side
constexpr double kMaxDistance = 10.0;   // [m] between the centre lines, where they are nearest
constexpr double kAtEnd = 0.001;        // [m]
constexpr double kNearBeside = 2.0;     // [m] between the centre lines of two lanes
constexpr double kFarBeside = 5.0;      // [m]
constexpr double kSameWay = 0.2;        // [rad]

/// Where a neighbour lies, seen from a lane.
struct Beside {
  double distance = std::numeric_limits<double>::infinity();  // where they are nearest [m]
  double l = 0.0;     // to the left where positive, where they are furthest apart; 0 where they never lie abreast [m]
  double turn = 0.0;  // between the headings there [rad]
};

/// By a few places along `other`.
Beside besideOf(const Polyline& lane, const Polyline& other) {
  Beside beside;
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    const double s = share * other.length();
    const FrenetPoint foot = lane.project(other.pointAt(s));
    beside.distance = std::min(beside.distance, foot.distance);
    const bool is_abreast = foot.s > kAtEnd && foot.s < lane.length() - kAtEnd && foot.distance <= kMaxDistance;
    if (!is_abreast || std::abs(foot.l) <= std::abs(beside.l)) continue;
    beside.l = foot.l;
    beside.turn = std::abs(angleBetween(lane.headingAt(foot.s), other.headingAt(s)));
  }
  return beside;
}

/// Of one lane after the other: changes its neighbours, and looks at the centre lines of others only.
class NeighbourCheck {
 public:
  NeighbourCheck(std::vector<Lane>* lanes, MapFaults* faults) : lanes_(*lanes), faults_(*faults) {}

  void mend(LaneIndex index) {
    Lane& lane = lanes_[index];
    std::vector<LaneIndex> left, right;
    for (const bool is_left : {true, false}) {
      for (const LaneIndex other : is_left ? lane.left_forward : lane.right_forward) {
        const auto lies_left = sideOf(lane, lanes_[other], is_left);
        if (lies_left) addOnce(other, *lies_left ? &left : &right);
      }
    }
    lane.left_forward = std::move(left);
    lane.right_forward = std::move(right);
  }

 private:
  /// True: to the left. nullopt: it is no neighbour in the same direction.
  std::optional<bool> sideOf(const Lane& lane, const Lane& other, bool stated_left) {
    Beside beside = besideOf(lane.center, other.center);
    if (beside.l == 0.0) {
      beside = besideOf(other.center, lane.center);
      beside.l = -beside.l;
    }
    const Point2d middle = lane.center.pointAt(lane.length() / 2.0);
    if (beside.distance > kMaxDistance) {
      faults_.add(MapFault::kNeighbourFar, {lane.id, other.id}, {middle, beside.distance}, other.id, " of ", lane.id,
                  ", ", metres(beside.distance), " off");
      return std::nullopt;
    }
    if (beside.turn > M_PI / 2.0) {
      faults_.add(MapFault::kNeighbourOncoming, {lane.id, other.id}, {middle}, other.id, " of ", lane.id);
      return std::nullopt;
    }
    const bool lies_left = std::abs(beside.l) < kClearlyBeside ? stated_left : beside.l > 0.0;
    if (lies_left != stated_left) {
      faults_.add(MapFault::kNeighbourWrongSide, {lane.id, other.id}, {middle}, other.id, ", stated as the ",
                  stated_left ? "left" : "right", " neighbour of ", lane.id);
    }
    return lies_left;
  }

  static void addOnce(LaneIndex lane, std::vector<LaneIndex>* lanes) {
    if (std::find(lanes->begin(), lanes->end(), lane) == lanes->end()) lanes->push_back(lane);
  }

  std::vector<Lane>& lanes_;
  MapFaults& faults_;
};

bool hasForwardNeighbour(const Lane& lane) {
  return lane.isDrivable() && !(lane.left_forward.empty() && lane.right_forward.empty());
}

/// Where more lanes than that lie around one on an average, they lie on each other, and nothing is said of neighbours.
constexpr std::size_t kMostAround = 200;

/// True where another driving lane lies beside the place, as wide apart as two lanes are, and runs the same way.
/// @param looked  at so many lanes; counted up.
bool hasLaneBeside(const MapContent& map, LaneIndex index, double s, std::size_t* looked) {
  LaneQuery query;
  query.max_distance = kFarBeside;
  query.heading = map.lanes[index].center.headingAt(s);
  query.max_heading_difference = kSameWay;
  const std::vector<LaneMatch> matches = lanesWithin(map, map.lanes[index].center.pointAt(s), query);
  *looked += matches.size();
  return std::any_of(matches.begin(), matches.end(), [index](const LaneMatch& match) {
    return match.lane != index && match.frenet.distance > kNearBeside;
  });
}

}  // namespace

void mendNeighbours(MapContent* map) {
  inBlocks(map->lanes.size(), &map->faults, [map](std::size_t begin, std::size_t end, MapFaults* faults) {
    NeighbourCheck check(&map->lanes, faults);
    for (std::size_t i = begin; i < end; ++i) check.mend(static_cast<LaneIndex>(i));
  });
}

/// They are not derived: where a file names none for any lane, nothing says which lines may be crossed.
void countMissingNeighbours(MapContent* map) {
  if (std::any_of(map->lanes.begin(), map->lanes.end(), hasForwardNeighbour)) return;
  std::size_t looked = 0;
  for (LaneIndex index = 0; index < map->lanes.size() && looked < kMostAround * map->lanes.size(); ++index) {
    const Lane& lane = map->lanes[index];
    const auto is_beside = [&](double share) { return hasLaneBeside(*map, index, share * lane.length(), &looked); };
    if (!lane.isDrivable() || !is_beside(0.25) || !is_beside(0.5) || !is_beside(0.75)) continue;
    map->faults.add(MapFault::kNeighboursMissing, {lane.id}, {lane.center.pointAt(lane.length() / 2.0)}, lane.id);
  }
}

}  // namespace external_command
