// SPDX-License-Identifier: Apache-2.0
#include "external_command/motion/collision_checker.h"

#include <algorithm>
#include <utility>

#include "collision_probe.h"
#include "external_command/core/parameter_range.h"
#include "footprint_index.h"

namespace external_command {

namespace {

Point2d originOf(const Region& region) {
  if (region.drivable()) return region.drivable()->points().front();
  if (!region.nonDrivable().empty()) return region.nonDrivable().front().points().front();
  if (region.grid()) return region.grid()->origin.position();
  return region.axleBounds() ? region.axleBounds()->min : Point2d(0.0, 0.0);
}

}  // namespace

struct CollisionChecker::Impl {
  Impl(const VehicleParams& vehicle, double margin, const Region& given, const std::vector<Pose2d>& eased_at,
       const Checkpoint& checkpoint)
      : region(given), origin(originOf(region)), index(vehicle, margin, region, origin, local(eased_at), checkpoint) {}

  Pose2d local(const Pose2d& pose) const { return {pose.x - origin.x(), pose.y - origin.y(), pose.heading}; }

  std::vector<Pose2d> local(const std::vector<Pose2d>& poses) const {
    std::vector<Pose2d> moved;
    for (const Pose2d& pose : poses) moved.push_back(local(pose));
    return moved;
  }

  Region region;
  Point2d origin;
  FootprintIndex index;
};

CollisionChecker::CollisionChecker(const VehicleParams& vehicle, double margin, const Region& region,
                                   const Checkpoint& checkpoint, const std::vector<Pose2d>& eased_at) {
  vehicle.validate();
  requireParameter("margin", margin, 0.0, 5.0);
  impl_ = std::make_unique<const Impl>(vehicle, margin, region, eased_at, checkpoint);
}

CollisionChecker::~CollisionChecker() = default;
CollisionChecker::CollisionChecker(CollisionChecker&&) noexcept = default;
CollisionChecker& CollisionChecker::operator=(CollisionChecker&&) noexcept = default;

double CollisionChecker::margin() const { return impl_->index.margin(); }

bool CollisionChecker::isFree(const Pose2d& pose) const { return impl_->index.isFree(impl_->local(pose)); }

std::optional<Collision> CollisionChecker::collisionAt(const Pose2d& pose) const {
  return probeCollision(impl_->index, impl_->local(pose));
}

double CollisionChecker::clearance(const Pose2d& pose, double limit) const {
  return impl_->index.clearance(Frame(impl_->local(pose)), limit).distance;
}

double CollisionChecker::minClearance(const Path& path, double limit) const {
  double smallest = limit;
  for (const ReferencePoint& point : path) smallest = std::min(smallest, clearance(point.pose(), smallest));
  return smallest;
}

std::string unknownCellsHint(const VehicleParams& vehicle, double margin, const Region& region, const Pose2d& pose,
                             const Checkpoint& checkpoint) {
  if (!region.grid() || !region.grid()->unknown_is_blocked) return "";
  OccupancyGrid grid = *region.grid();
  grid.unknown_is_blocked = false;
  const Region known({region.drivable(), region.nonDrivable(), std::move(grid), region.axleBounds(), region.limits()});
  if (!CollisionChecker(vehicle, margin, known, checkpoint).isFree(pose)) return "";
  return ", where cells of the obstacle grid are unknown, which counts as blocked (~grid_unknown_is_blocked)";
}

}  // namespace external_command
