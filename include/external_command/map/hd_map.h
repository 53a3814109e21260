// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/polygon.h"
#include "external_command/core/polyline.h"
#include "external_command/map/map_data.h"
#include "external_command/map/map_fault.h"

namespace external_command {

/// Position of a lane in HdMap::lanes().
using LaneIndex = std::uint32_t;

/// The height of a lane's centre line at `s`; in between it goes on evenly.
struct HeightSample {
  double s = 0.0;  ///< [m]
  double z = 0.0;  ///< [m]
};

/// A lane with every reference resolved.
struct Lane {
  std::string id;
  Polyline center = Polyline::blank();
  LaneBoundary left, right;
  std::vector<WidthSample> left_widths, right_widths;
  double speed_limit = 0.0;  ///< [m/s], 0 where the map gives none
  LaneType type = LaneType::kNone;
  LaneTurn turn = LaneTurn::kNoTurn;
  LaneDirection direction = LaneDirection::kForward;
  std::vector<LaneIndex> predecessors, successors;     ///< where routes lead; the file's, but for the gaps
  std::vector<LaneIndex> left_forward, right_forward;  ///< neighbours in the same direction, drivable or not
  std::vector<LaneIndex> left_reverse, right_reverse;  ///< neighbours in the opposite direction
  std::string road_id;                                 ///< empty where no road names the lane
  std::string junction_id;                             ///< empty outside junctions
  std::vector<HeightSample> heights;                   ///< to about 0.1 m; empty where the map gives none
  /// Of each successor: the place on it where this lane ends; above 0 where the successor begins before that [m].
  std::vector<double> entries = {};
  std::optional<LaneIndex> reverse = {};  ///< the same lane driven the other way, of a lane of both directions
  bool is_reversed = false;               ///< driven against the centre line of the file, whose id it has

  /// Arc length along the centre line of the file [m].
  double statedS(double s) const { return is_reversed ? length() - s : s; }

  double length() const { return center.length(); }

  /// City driving, or shared with it: what a route may use.
  bool isDrivable() const { return type == LaneType::kCityDriving || type == LaneType::kShared; }

  /// From the centre line to the boundary at that side [m] at `s`, by the samples, else by the boundaries, else 1.75 m.
  double leftWidthAt(double s) const;
  double rightWidthAt(double s) const;
  double widthAt(double s) const { return leftWidthAt(s) + rightWidthAt(s); }

  /// Height of the centre line [m]; nullopt where the map gives none.
  std::optional<double> heightAt(double s) const;
};

/// A lane under or beside a map object, by the file's overlaps.
struct LaneOverlap {
  LaneIndex lane;
  double start_s;  ///< [m]
  double end_s;    ///< [m]
};

/// A link of the file that is not driven, as its ends lie too far apart.
struct BrokenLink {
  LaneIndex from = 0, onto = 0;
  double gap = 0.0;  ///< [m]
};

struct MapParams {
  double max_link_gap = 2.0;            ///< links whose ends lie further apart are not driven [m]
  double max_segment_length = 10000.0;  ///< lanes with two points of the centre line further apart are dropped [m]
  bool keep_findings = false;           ///< findings() tells each fault, not only how many there are of a kind

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

struct Junction {
  std::string id;
  Polygon polygon;
};

struct ParkingSpace {
  std::string id;
  Polygon polygon;
  double heading;                  ///< in which a vehicle parked nose in points [rad]
  std::vector<LaneOverlap> lanes;  ///< empty where the map has no overlaps for it
};

struct Area {
  std::string id;
  std::string name;
  Polygon polygon;
  std::vector<LaneOverlap> lanes;
};

/// Which lanes a spatial query looks at.
struct LaneQuery {
  double max_distance = 1e9;             ///< from the point to the centre line [m]
  std::optional<double> heading;         ///< only stretches of lanes whose heading differs from this by at most ...
  double max_heading_difference = M_PI;  ///< ... this much [rad]
  bool drivable_only = true;
};

/// A lane near a point, by the nearest place of a stretch of it that satisfies the query.
struct LaneMatch {
  LaneIndex lane = 0;
  FrenetPoint frenet;
  double heading = 0.0;  ///< of the lane at the foot point [rad]
};

struct MapContent;  // as src/map has it

/// An HD map: immutable once built, every query const and thread-safe, no caches.
///
/// Maps of the wild leave fields empty or wrong. Each of the following is counted in `warnings()` unless marked (*).
/// Derived:
/// - `length`: always the centre line's; a stated one is only compared with it.
/// - `predecessors`: where no lane of the whole map states any, the inverse of the successors (*); the same the other
///   way round.
/// - `junction_id`: the lane's own, else its road's, else the junction that takes half of it by the overlaps (*).
/// - lanes of an object: by the overlaps it names; where it names none, by those that name it (*).
/// - heading of a parking space, where it is missing or lies across the space: along the longer side, away from the
///   nearest drivable lane; with the traffic where the space lies along the lane. A stated one of more than a full turn
///   is in degrees if that fits the space.
/// - four corners of a parking space in crossed order: put in order.
///
/// - the other direction of a driving lane of both directions: a lane of its own with the same id (*), see
///   Lane::reverse. What else `direction` says decides nothing: lanes are driven along their centre lines.
/// - the centre line of a lane of no length, just over 1 mm long, so that it keeps its links.
/// - the side of a neighbour, where it clearly lies on the other than the file states.
///
/// Done without: neighbours (never derived: nothing says which line may be crossed), overlaps of parking spaces, speed
/// limits (*), widths (*, see Lane::widthAt).
///
/// Dropped: lanes without an id, with an earlier lane's id, with fewer than two distinct points, with a coordinate that
/// is not finite or beyond 1e8 m, with two points further apart than MapParams::max_segment_length; references and
/// overlaps that dangle; boundaries, widths and speed limits out of range; junctions, parking spaces and areas whose
/// polygon is not simple; forward neighbours that run the other way or lie too far off; links whose ends lie further
/// apart than MapParams::max_link_gap, see brokenLinks().
///
/// Counted, the worst named: links whose ends do not meet, overlap, or jump in heading; centre lines that fold back.
///
/// What a file states is otherwise left as it is: a successor need not name the lane as its predecessor.
class HdMap {
 public:
  /// Resolves, derives and drops as above. O(n log n).
  /// @param origin  is subtracted from every coordinate [m].
  /// @throws MapError  no usable lane is left, or the overlaps give objects far more lanes than they name.
  HdMap(MapData data, const Point2d& origin, const MapParams& params = {});
  /// One that was resolved before.
  explicit HdMap(MapContent content);
  ~HdMap();
  HdMap(const HdMap&) = delete;
  HdMap& operator=(const HdMap&) = delete;

  const std::string& version() const;
  const std::string& projection() const;
  const Point2d& origin() const;
  const BoundingBox& box() const;

  const std::vector<Lane>& lanes() const;
  const Lane& lane(LaneIndex index) const { return lanes()[index]; }
  const std::vector<Junction>& junctions() const;
  const std::vector<ParkingSpace>& parkingSpaces() const;
  const std::vector<Area>& areas() const;
  const std::vector<MapWarning>& warnings() const;
  const std::vector<MapFinding>& findings() const;  ///< empty without MapParams::keep_findings
  const std::vector<BrokenLink>& brokenLinks() const;

  /// In the direction of its centre line.
  std::optional<LaneIndex> findLane(const std::string& id) const;
  const ParkingSpace* findParkingSpace(const std::string& id) const;   ///< nullptr where there is none
  std::string whyUnusable(const std::string& parking_space_id) const;  ///< one that was dropped; empty for any other
  const Area* findArea(const std::string& id) const;                   ///< nullptr where there is none

  /// Lanes of a road; empty where the road is unknown (`hasRoad` tells).
  std::vector<LaneIndex> lanesOfRoad(const std::string& road_id) const;
  bool hasRoad(const std::string& road_id) const;

  /// The nearest lane that satisfies `query`; nullopt where there is none.
  std::optional<LaneMatch> nearestLane(const Point2d& point, const LaneQuery& query) const;

  /// Every lane within `query.max_distance`, the nearest first; a lane that passes the point several times (a spiral
  /// ramp, a turn back) once for each time.
  std::vector<LaneMatch> lanesWithin(const Point2d& point, const LaneQuery& query) const;

  /// The first area (in file order) that contains `point`; nullptr where none does.
  const Area* areaAt(const Point2d& point) const;

  /// For what keeps maps.
  const MapContent& content() const { return *content_; }

 private:
  std::unique_ptr<const MapContent> content_;
};

}  // namespace external_command
