// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "external_command/map/hd_map.h"

namespace external_command {

/// Draws small maps for tests:
///
///   MapBuilder builder;                      //   a ----> b ----> c
///   builder.lane("a", {0, 0}, {100, 0})      //   d ----> e
///       .lane("b", {100, 0}, {200, 0})
///       .follow({"a", "b"});
///   const auto map = builder.build();
///
/// Lanes are city driving, 3.5 m wide, with boundaries, 50 km/h. References are plain ids and may dangle.
class MapBuilder {
 public:
  static constexpr double kLaneWidth = 3.5;    // [m]
  static constexpr double kSpeedLimit = 13.9;  // [m/s]

  /// A straight lane, a point every 5 m or less.
  MapBuilder& lane(const std::string& id, const Point2d& from, const Point2d& to);

  /// A lane through these points and no others.
  MapBuilder& lane(const std::string& id, const std::vector<Point2d>& points);

  /// A lane that turns by `angle` [rad, positive to the left] on a circle of `radius` [m], beginning at `start`.
  MapBuilder& arc(const std::string& id, const Pose2d& start, double radius, double angle);

  /// Each lane leads into the next: successors and predecessors.
  MapBuilder& follow(std::initializer_list<std::string> ids);

  /// Lanes side by side in the same direction, from left to right; each is the next one's forward neighbour, with a
  /// dotted white line between.
  MapBuilder& beside(std::initializer_list<std::string> ids);

  /// Two lanes of opposite directions, each at the other's left.
  MapBuilder& opposite(const std::string& a, const std::string& b);

  MapBuilder& road(const std::string& id, std::initializer_list<std::string> lanes, const std::string& junction = "");
  MapBuilder& junction(const std::string& id, const std::vector<Point2d>& polygon);

  /// A rectangle, `middle.heading` along its length and stated as the space's heading. Each lane overlaps it in all of
  /// its length.
  MapBuilder& parkingSpace(const std::string& id, const Pose2d& middle, double length, double width,
                           std::initializer_list<std::string> lanes = {});

  MapBuilder& area(const std::string& id, const std::vector<Point2d>& polygon, const std::string& name = "");

  /// Everything not covered above is set on the data itself.
  /// @throws std::out_of_range  no such lane.
  LaneData& operator[](const std::string& lane_id);
  MapData& data() { return data_; }

  std::shared_ptr<const HdMap> build(const Point2d& origin = Point2d::Zero()) const;

 private:
  MapData data_;
};

/// Index of a lane that must exist.
/// @throws std::out_of_range  no such lane.
LaneIndex laneIndex(const HdMap& map, const std::string& id);

}  // namespace external_command
