// SPDX-License-Identifier: Apache-2.0
#include "checks.h"
#include "external_command/core/error.h"
#include "external_command/routing/lane_way_tool.h"

namespace external_command {

namespace {

constexpr double kOverhang = 1.5;   // as valet_parking_command_processor/parking_max_overhang [m]
constexpr double kTolerance = 0.2;  // as parking_position_tolerance there [m]

Point2d middleOf(const ParkingSpace& space) {
  const BoundingBox& box = space.polygon.box();
  return (box.min + box.max) / 2.0;
}

/// Along its heading, and across.
Point2d sizeOf(const ParkingSpace& space) {
  const Point2d ahead = unitVector(space.heading), left(-ahead.y(), ahead.x());
  Point2d low = Point2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Point2d& corner : space.polygon.points()) {
    const Point2d local(corner.dot(ahead), corner.dot(left));
    low = low.cwiseMin(local);
    high = high.cwiseMax(local);
  }
  return high - low;
}

void checkSize(const MapUnderCheck& check, const ParkingSpace& space) {
  const VehicleParams& vehicle = check.vehicle;
  const Point2d size = sizeOf(space);
  const double missing = std::max(vehicle.length() - size.x(), vehicle.width - size.y());
  if (missing <= 0.0) return;
  const bool is_hopeless = size.x() < vehicle.length() - kOverhang || size.y() < vehicle.width - kTolerance;
  check.faults->add(is_hopeless ? MapFault::kSpaceTooSmall : MapFault::kSpaceSmall, {space.id},
                    {middleOf(space), missing}, space.id, ": ", metres(size.x()), " x ", metres(size.y()),
                    "; the vehicle is ", metres(vehicle.length()), " x ", metres(vehicle.width));
}

}  // namespace

void checkSpaces(const MapUnderCheck& check) {
  const LaneWayTool tool(check.map, LaneWayParams());
  for (const ParkingSpace& space : check.map.parkingSpaces()) {
    try {
      tool.fromParkingSpace(space.id, nullptr);
    } catch (const OffMap& error) {
      check.faults->add(MapFault::kSpaceWithoutAccess, {space.id}, {middleOf(space)}, error.what());
    }
    checkSize(check, space);
  }
}

}  // namespace external_command
