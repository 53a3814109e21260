// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <unordered_set>

#include "checks.h"
#include "named_ids.h"

namespace external_command {

namespace {

using Ids = std::vector<std::string>;

class References {
 public:
  explicit References(const MapUnderCheck& check) : check_(check) {
    for (const LaneData& lane : check.stated.lanes) {
      if (lane_by_id_.emplace(lane.id, &lane).second) addNames(lane);
      states_successors_ |= !lane.successors.empty();
      states_predecessors_ |= !lane.predecessors.empty();
    }
    for (const JunctionData& junction : check.stated.junctions) junctions_.insert(junction.id);
  }

  void run() {
    for (const LaneData& lane : check_.stated.lanes) {
      if (lane_by_id_.at(lane.id) == &lane) checkLane(lane);
    }
    if (check_.stated.roads.empty()) {
      check_.notes->push_back("the map states no roads: blacklisted_road of a command can name none");
    }
    checkRoads();
    checkIds();
  }

 private:
  void addNames(const LaneData& lane) {
    successors_.add(lane.id, lane.successors);
    predecessors_.add(lane.id, lane.predecessors);
    for (const Ids* ids : {&lane.left_forward, &lane.right_forward}) forward_.add(lane.id, *ids);
    for (const Ids* ids : {&lane.left_reverse, &lane.right_reverse}) reverse_.add(lane.id, *ids);
  }

  void checkLane(const LaneData& lane) {
    const Lane* used = usedLane(lane.id);
    if (used == nullptr) return;
    checkJunction(lane.junction, "lane", lane.id);
    if (!used->isDrivable()) return;
    if (states_successors_ && states_predecessors_) checkLinks(lane, *used);
    checkNeighbours(lane, *used);
    checkReverseNeighbours(lane, *used);
    if (check_.stated.roads.empty() || !used->road_id.empty()) return;
    check_.faults->add(MapFault::kLaneWithoutRoad, {lane.id}, {used->center.points().front()}, lane.id);
  }

  const Lane* usedLane(const std::string& id) const {
    const auto index = check_.map.findLane(id);
    return index ? &check_.map.lane(*index) : nullptr;
  }

  /// A lane that is driven on, as the file states it; nullptr where there is none.
  const LaneData* driven(const std::string& id) const {
    const Lane* used = usedLane(id);
    return used != nullptr && used->isDrivable() ? lane_by_id_.at(id) : nullptr;
  }

  template <class... Args>
  void add(MapFault fault, const LaneData& lane, const LaneData& other, const Point2d& place, const Args&... what) {
    check_.faults->add(fault, {lane.id, other.id}, {place}, what...);
  }

  void checkLinks(const LaneData& lane, const Lane& used) {
    for (const std::string& id : lane.successors) {
      const LaneData* next = driven(id);
      if (next == nullptr || predecessors_.has(id, lane.id)) continue;
      add(MapFault::kLinkOneSided, lane, *next, used.center.points().back(), lane.id, " to ", id, ": ", id,
          " does not have it as predecessor; it is driven");
    }
    for (const std::string& id : lane.predecessors) {
      const LaneData* before = driven(id);
      if (before == nullptr || successors_.has(id, lane.id)) continue;
      add(MapFault::kLinkOneSided, *before, lane, used.center.points().front(), id, " to ", lane.id, ": ", id,
          " does not have it as successor; it is not driven");
    }
  }

  void checkNeighbours(const LaneData& lane, const Lane& used) {
    const auto check = [&](const Ids& ids, const char* kind, const NamedIds& neighbours) {
      for (const std::string& id : ids) {
        const LaneData* other = driven(id);
        if (other == nullptr || other == &lane || neighbours.has(id, lane.id)) continue;
        add(MapFault::kNeighbourOneSided, lane, *other, used.center.points().front(), id, " is the ", kind,
            " neighbour of ", lane.id, ", but not the other way round");
      }
    };
    check(lane.left_forward, "left forward", forward_);
    check(lane.right_forward, "right forward", forward_);
    check(lane.left_reverse, "left reverse", reverse_);
    check(lane.right_reverse, "right reverse", reverse_);
  }

  void checkReverseNeighbours(const LaneData& stated, const Lane& lane) {
    const Point2d middle = lane.center.pointAt(lane.length() / 2.0);
    const double heading = lane.center.headingAt(lane.length() / 2.0);
    for (const Ids* ids : {&stated.left_reverse, &stated.right_reverse}) {
      for (const std::string& id : *ids) {
        const LaneData* other = driven(id);
        if (other == nullptr || other == &stated) continue;
        const Polyline& line = usedLane(id)->center;
        const double turn = std::abs(angleBetween(heading, line.headingAt(line.project(middle).s)));
        if (turn > M_PI / 2.0) continue;
        add(MapFault::kNeighbourNotOncoming, stated, *other, middle, id, " of ", lane.id);
      }
    }
  }

  void checkJunction(const std::string& junction, const char* kind, const std::string& id) {
    if (junction.empty() || junctions_.count(junction) > 0) return;
    check_.faults->add(MapFault::kJunctionDangling, {id, junction}, {}, "junction ", junction, " of ", kind, " ", id);
  }

  void checkRoads() {
    for (const RoadData& road : check_.stated.roads) checkJunction(road.junction, "road", road.id);
  }

  template <class Objects>
  void checkIdsOf(const Objects& objects, const char* kind) {
    std::unordered_set<std::string_view> known;
    for (const auto& object : objects) {
      if (known.insert(object.id).second) continue;
      check_.faults->add(MapFault::kIdRepeated, {object.id}, {}, kind, " ", object.id);
    }
  }

  void checkIds() {
    checkIdsOf(check_.stated.roads, "road");
    checkIdsOf(check_.stated.junctions, "junction");
    checkIdsOf(check_.stated.overlaps, "overlap");
  }

  const MapUnderCheck& check_;
  std::unordered_map<std::string_view, const LaneData*> lane_by_id_;  // the first of each id, which is the one used
  NamedIds successors_, predecessors_, forward_, reverse_;            // by these
  std::unordered_set<std::string_view> junctions_;
  bool states_successors_ = false, states_predecessors_ = false;
};

}  // namespace

void checkReferences(const MapUnderCheck& check) { References(check).run(); }

}  // namespace external_command
