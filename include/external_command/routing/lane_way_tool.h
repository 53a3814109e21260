// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "external_command/routing/router.h"

namespace external_command {

struct LaneWayParams {
  double snap_distance = 3.0;            ///< from a pose with heading to its lane, at most [m]
  double snap_heading = 1.0;             ///< between pose and lane, at most [rad]
  double max_goal_distance = 10.0;       ///< from a pose without heading to its lane, at most [m]
  double lane_keeping_error = 1.0;       ///< lanes that are further off by no more than this could be meant too [m]
  double heading_error = 0.3;            ///< the same by heading, where the pose has one [rad]
  double height_error = 2.0;             ///< the same by height, where pose and map have one [m]
  double off_lane_price = 100.0;         ///< that a candidate costs for each metre it is off [m/m]
  double off_heading_price = 100.0;      ///< that a candidate costs for each radian its heading is off [m/rad]
  double off_lane_distance = 2.0;        ///< a vehicle with no lane this near ... [m]
  double off_lane_heading = M_PI / 3.0;  ///< ... and within this of its heading [rad] is off the lanes (park-and-go)
  double park_and_go_radius = 20.0;      ///< it then starts from any lane this near [m]
  double area_access_distance = 10.0;    ///< of lanes to the area that a vehicle stands in, at most [m]
  double parking_lane_radius = 20.0;     ///< lanes beside a parking space without overlaps, at most [m]

  /// @throws InvalidParameter  out of range.
  void validate() const;
};

/// What else is known of a pose that lies on a lane.
struct LaneHint {
  std::optional<double> height = {};  ///< [m]
  std::string lane_id = {};           ///< the lane itself; empty: not known
};

/// From poses to points on lanes. Only drivable lanes count. Const and thread-safe; refers to `map`, which must outlive
/// it.
class LaneWayTool {
 public:
  LaneWayTool(const HdMap& map, const LaneWayParams& params);

  /// Candidates for a way point or goal: the nearest lane, within `snap_distance` and `snap_heading` where a heading is
  /// given, within `max_goal_distance` where not, and those that are off by at most `lane_keeping_error` more; of these
  /// the ones whose heading fits best, to `heading_error`. Each has the price of being off; the nearest comes first.
  /// Lanes of another height than the hint's do not count, see onDeck(), nor do others than its lane.
  /// @param name  of the field, "end_pose": error texts begin with it.
  /// @throws OffMap  there is none; the text names the nearest lane, its distance and what else does not fit, and the
  /// limits.
  /// @throws InvalidRequest  the pose is not finite, or the hint's lane is unknown or not to be driven on.
  std::vector<LanePoint> fromPose(const Point2d& point, const std::optional<double>& heading, const std::string& name,
                                  const LaneHint& hint = {}) const;

  /// A point that is given by its lane.
  /// @param name  of the field, "waypoint[1]": error texts begin with it.
  /// @throws InvalidRequest  no such lane, none to drive on, or `s` lies more than 0.1 m outside it.
  LanePoint fromLane(const std::string& id, double s, const std::string& name) const;

  /// Candidates for the start: the vehicle's own lane and those that it could as well be on, as above but within
  /// `off_lane_distance` and `off_lane_heading`; or, for a vehicle off the lanes, every lane within
  /// `park_and_go_radius`, at no price, so that routing picks the one with the shortest route. From inside an area the
  /// vehicle starts where lanes give access to it, at the price of the way there; see accessPoints().
  /// @param height  of the vehicle, where it is known [m].
  /// @throws OffMap  no lane within that radius.
  /// @throws InvalidRequest  the pose is not finite.
  std::vector<LanePoint> fromVehicle(const Pose2d& vehicle, const std::optional<double>& height = {}) const;

  /// True where `vehicle` is away from any lane, of its deck where the height is known [m].
  bool isOffLane(const Pose2d& vehicle, const std::optional<double>& height = {}) const;

  /// Candidates to park from: on each lane that overlaps the space, the point abreast of it; where the map has no
  /// overlaps the drivable lanes within `parking_lane_radius` (`used_geometry` is then set).
  /// @throws InvalidRequest  no such parking space: the text names the id.
  /// @throws OffMap  no lane is near it.
  std::vector<LanePoint> fromParkingSpace(const std::string& id, bool* used_geometry) const;

  /// The points abreast of the space on the drivable lanes whose edge comes within `max_gap` [m] of it, whatever the
  /// map's overlaps say; the nearest first.
  std::vector<LanePoint> alongParkingSpace(const ParkingSpace& space, double max_gap) const;

  /// Every drivable lane within `radius` [m] of `point`, the nearest first.
  std::vector<LanePoint> within(const Point2d& point, double radius) const;

 private:
  std::vector<LanePoint> candidates(const Point2d& point, LaneQuery query, const LaneHint& hint) const;

  /// The lanes that `query` finds and that lie at `height`. Where none does within `park_and_go_radius`, map and
  /// localization count heights from different places: then those of the deck that is nearest by height.
  std::vector<LaneMatch> onDeck(const Point2d& point, const LaneQuery& query, double height) const;

  /// @throws InvalidRequest  no such lane, or none to drive on.
  LaneIndex requireLane(const std::string& id, const std::string& name) const;

  OffMap offMap(const Point2d& point, const std::optional<double>& heading, const std::string& name,
                const LaneHint& hint) const;

  std::vector<LanePoint> fromArea(const Point2d& point) const;

  LaneQuery ownLanes(const Pose2d& vehicle) const;

  const HdMap& map_;
  LaneWayParams params_;
};

}  // namespace external_command
