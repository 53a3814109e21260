// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/path.h"
#include "external_command/core/pose.h"
#include "external_command/core/vehicle.h"
#include "external_command/motion/region.h"

namespace external_command {

/// What a footprint runs into.
struct Collision {
  enum class Kind { kDrivableBorder, kNonDrivable, kGrid, kAxleBounds };

  Kind kind = Kind::kNonDrivable;
  std::size_t index = 0;  ///< of the polygon in Region::nonDrivable(); 0 for the other kinds
  std::string obstacle;   ///< its polygon's name, "parking space p7"; else "the obstacle grid", "the axle bounds"
  double depth = 0.0;     ///< about how far the footprint must move to be `margin` away from it, in (0, 64] [m]
  Point2d at{0.0, 0.0};   ///< a point of the obstacle in the footprint, or nearest to it

  /// "by 0.27 m", or "by more than 64.00 m" where no way out was found.
  std::string extent() const;

  /// "overlaps parking space p7 by 0.27 m", "sticks out of drivable_roi by 1.20 m".
  std::string description() const;
};

/// The vehicle's exact footprint against the exact obstacles of a region. Immutable and thread-safe.
class CollisionChecker {
 public:
  /// Builds an index over the region's edges; about a millisecond for a hundred polygons.
  /// @param margin  the footprint keeps at least this distance to every obstacle and border, not negative [m].
  /// @param checkpoint  called now and then meanwhile: a large region takes a second.
  /// @param eased_at  poses that have to be taken: an obstacle that one of them is nearer to than the margin, without
  ///                  meeting it, may be approached to half of that distance within about a vehicle's length.
  /// @throws InvalidParameter  vehicle or margin is out of range.
  /// @throws InvalidRequest  the region has more edges than its limits allow.
  CollisionChecker(
      const VehicleParams& vehicle, double margin, const Region& region, const Checkpoint& checkpoint = [] {},
      const std::vector<Pose2d>& eased_at = {});
  ~CollisionChecker();
  CollisionChecker(CollisionChecker&&) noexcept;
  CollisionChecker& operator=(CollisionChecker&&) noexcept;

  double margin() const;

  /// True where the footprint at `pose` keeps the margin. 10 to 200 ns near a few dozen edges.
  bool isFree(const Pose2d& pose) const;

  /// The deepest collision at `pose`; nullopt exactly where isFree().
  std::optional<Collision> collisionAt(const Pose2d& pose) const;

  /// Distance [m] from the bare footprint to the nearest obstacle or border: 0 where it touches or overlaps one, at
  /// most `limit`. The axle bounds do not count.
  double clearance(const Pose2d& pose, double limit = 10.0) const;

  /// Smallest clearance of the path's points.
  double minClearance(const Path& path, double limit = 10.0) const;

 private:
  struct Impl;
  std::unique_ptr<const Impl> impl_;
};

/// For an error text about `pose`: ", where cells of the obstacle grid are unknown ..." with the parameter, where the
/// pose would be free if these cells were; else empty. Takes as long as making a CollisionChecker.
std::string unknownCellsHint(const VehicleParams& vehicle, double margin, const Region& region, const Pose2d& pose,
                             const Checkpoint& checkpoint);

}  // namespace external_command
