// SPDX-License-Identifier: Apache-2.0
#include "support/map_matchers.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace external_command {

namespace {

constexpr int kPlaces = 20;  // along and across a map, at which it is asked

/// Everything in words, digit by digit.
class Description {
 public:
  explicit Description(const HdMap& map) : map_(map) {
    out_ << std::hexfloat << map.version() << '|' << map.projection() << '|' << map.origin().transpose() << '\n';
    add(map.box());
    for (const Lane& lane : map.lanes()) add(lane);
    for (const Junction& junction : map.junctions()) add("junction", junction.id, junction.polygon);
    for (const ParkingSpace& space : map.parkingSpaces()) {
      add("space", space.id, space.polygon);
      out_ << space.heading << " found " << (map.findParkingSpace(space.id) == &space);
      add(space.lanes);
    }
    for (const Area& area : map.areas()) {
      add("area", area.id + ' ' + area.name, area.polygon);
      out_ << " found " << (map.findArea(area.id) == &area);
      add(area.lanes);
    }
    for (const MapWarning& warning : map.warnings()) out_ << warning.count << ' ' << warning.what << '\n';
    for (const BrokenLink& link : map.brokenLinks()) {
      out_ << "broken " << link.from << ' ' << link.onto << ' ' << link.gap << '\n';
    }
    addPlaces();
  }

  std::string text() const { return out_.str(); }

 private:
  template <class Values>
  void addAll(const char* what, const Values& values) {
    out_ << '\n' << what;
    for (const auto& value : values) out_ << ' ' << value;
  }

  void add(const BoundingBox& box) { out_ << box.min.transpose() << " to " << box.max.transpose() << '\n'; }

  void add(const char* what, const std::vector<Point2d>& points) {
    out_ << '\n' << what;
    for (const Point2d& point : points) out_ << ' ' << point.x() << ' ' << point.y();
  }

  void add(const char* kind, const std::string& id, const Polygon& polygon) {
    out_ << '\n' << kind << ' ' << id;
    add("polygon", polygon.points());
    out_ << ' ' << polygon.name() << ' ' << polygon.area() << ' ';
    add(polygon.box());
  }

  void add(const std::vector<LaneOverlap>& lanes) {
    for (const LaneOverlap& lane : lanes) out_ << ' ' << lane.lane << ':' << lane.start_s << '-' << lane.end_s;
    out_ << '\n';
  }

  void add(const LaneBoundary& boundary) {
    add(boundary.is_virtual ? "virtual" : "real", boundary.points);
    for (const BoundaryTypeChange& change : boundary.types) {
      out_ << ' ' << change.s << ':' << static_cast<int>(change.type);
    }
  }

  void add(const Lane& lane) {
    out_ << "\nlane " << lane.id << '|' << lane.road_id << '|' << lane.junction_id << '|' << lane.speed_limit << ' '
         << static_cast<int>(lane.type) << static_cast<int>(lane.turn) << static_cast<int>(lane.direction)
         << lane.is_reversed << ' ' << (lane.reverse ? static_cast<int>(*lane.reverse) : -1) << " found "
         << map_.findLane(lane.id).value_or(0) << " road";
    for (const LaneIndex other : map_.lanesOfRoad(lane.road_id)) out_ << ' ' << other;
    add("center", lane.center.points());
    addAll("s", lane.center.arcLengths());
    add(lane.left);
    add(lane.right);
    for (const auto* widths : {&lane.left_widths, &lane.right_widths}) {
      out_ << "\nwidths";
      for (const WidthSample& sample : *widths) out_ << ' ' << sample.s << ':' << sample.width;
    }
    out_ << "\nheights";
    for (const HeightSample& sample : lane.heights) out_ << ' ' << sample.s << ':' << sample.z;
    for (const auto* others : {&lane.predecessors, &lane.successors, &lane.left_forward, &lane.right_forward,
                               &lane.left_reverse, &lane.right_reverse}) {
      addAll("others", *others);
    }
    addAll("entries", lane.entries);
  }

  void addPlaces() {
    LaneQuery query;
    query.max_distance = 30.0;
    query.drivable_only = false;
    const Point2d step = (map_.box().max - map_.box().min) / kPlaces;
    for (int i = 0; i < kPlaces * kPlaces; ++i) {
      const Point2d place = map_.box().min + Point2d(step.x() * (i % kPlaces), step.y() * (i / kPlaces));
      if (const auto match = map_.nearestLane(place, {})) out_ << match->lane << ' ' << match->frenet.s << '\n';
      for (const LaneMatch& match : map_.lanesWithin(place, query)) out_ << ' ' << match.lane << ':' << match.frenet.s;
      const Area* area = map_.areaAt(place);
      out_ << " in " << (area ? area->id : "none") << '\n';
    }
  }

  const HdMap& map_;
  std::ostringstream out_;
};

}  // namespace

testing::AssertionResult sameMap(const HdMap& a, const HdMap& b) {
  const std::string first = Description(a).text(), second = Description(b).text();
  if (first == second) return testing::AssertionSuccess();
  const auto differ = std::mismatch(first.begin(), first.end(), second.begin(), second.end());
  const auto at = static_cast<std::size_t>(differ.first - first.begin());
  const std::size_t begin = at < 60 ? 0 : at - 60;
  return testing::AssertionFailure() << "\"" << first.substr(begin, 120) << "\" is not \"" << second.substr(begin, 120)
                                     << "\"";
}

}  // namespace external_command
