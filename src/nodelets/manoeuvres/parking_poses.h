// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/map/hd_map.h"
#include "external_command/motion/collision_checker.h"
#include "external_command/ros/parameters.h"

namespace external_command {

/// How a vehicle stands in a parking space.
enum class ParkingDirection { kNoseIn, kBackingIn, kCheaper };

struct ParkingParams {
  ParkingDirection direction = ParkingDirection::kCheaper;
  double position_tolerance = 0.2;  ///< from the middle of a space, where that is blocked [m]
  double heading_tolerance = 0.05;  ///< from its heading, where that is blocked [rad]
  double max_overhang = 1.5;        ///< by which a vehicle may stick out of a space towards the lane [m]
};

/// `parking_direction`, `parking_position_tolerance`, `parking_heading_tolerance`, `parking_max_overhang`.
/// @throws InvalidParameter
ParkingParams readParkingParams(const ParameterReader& reader);

/// Where a vehicle stands in a space of the map, and what room that takes.
class ParkingSpot {
 public:
  /// @param margin  kept to the far end of the space [m].
  ParkingSpot(const ParkingSpace& space, const VehicleParams& vehicle, double margin, const ParkingParams& params);

  /// What is missing for the vehicle, margin and tolerances left out; empty: it fits.
  std::string shortage() const;

  /// True where the vehicle is longer or wider than the space.
  bool isSmall() const;

  double length() const { return length_; }  ///< of the space along its heading [m]
  double width() const { return width_; }    ///< of the space across its heading [m]

  /// Poses of the rear-axle centre with the vehicle in the middle of the space, or, where that is too short, sticking
  /// out of it towards the lane: nose in, backing in, or both.
  std::vector<Pose2d> poses() const { return posesAt({0.0, 0.0, 0.0}); }

  /// Those that are free; each that is not is replaced by the nearest free one within the tolerances, if there is one.
  std::vector<Pose2d> freePoses(const CollisionChecker& obstacles) const;

  /// How far the vehicle, parked at `pose`, is from the middle of the space, and turned against its heading.
  Pose2d offsetOf(const Pose2d& pose) const;

  /// The space together with what the vehicle needs at `parked`: spaces of real maps are drawn roughly.
  Polygon placeFor(const std::vector<Pose2d>& parked) const;

 private:
  std::vector<Pose2d> posesAt(const Pose2d& offset) const;
  std::vector<Pose2d> offsets() const;

  const ParkingSpace& space_;
  VehicleParams vehicle_;
  double margin_;
  ParkingParams params_;
  double length_ = 0.0, width_ = 0.0;
  Pose2d middle_;           ///< of the parked vehicle, nose in
  double ahead_of_middle_;  ///< room there, which the vehicle may move on into the space [m]
};

}  // namespace external_command
