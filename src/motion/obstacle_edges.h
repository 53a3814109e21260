// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/pose.h"
#include "external_command/motion/region.h"

namespace external_command {

/// Who an edge belongs to: the index of a non-drivable polygon, or one of these.
enum EdgeSource : int { kDrivableSource = -1, kGridSource = -2 };

/// A straight piece of an obstacle's border, in the local frame.
struct ObstacleEdge {
  Point2d begin;
  Point2d end;
  int source = 0;
};

/// The region around a local origin, as filled shapes bordered by edges. Keeps a reference to `region`.
class LocalObstacles {
 public:
  /// @throws InvalidRequest  the borders have more edges than RegionLimits allow.
  LocalObstacles(const Region& region, const Point2d& origin, const Checkpoint& checkpoint);

  const std::vector<ObstacleEdge>& edges() const { return edges_; }
  const Region& region() const { return *region_; }
  const Point2d& origin() const { return origin_; }

  /// Leaves the part of an edge from `from` to `to` of its length, 0 to 1, in its place; the rest comes after all
  /// others.
  void cutEdge(std::size_t edge, double from, double to);

  /// Who fills the point, given in the local frame; nullopt where it is free. O(edges) but for boxes that miss it.
  std::optional<int> filledBy(const Point2d& local) const;

  /// Whether `source` fills the point.
  bool isFilledBy(int source, const Point2d& local) const;

  /// True where everything far outside is filled: a drivable border, or a grid beyond which all is blocked.
  bool isOutsideFilled() const;

 private:
  void addPolygon(const Polygon& polygon, int source);
  void addGrid(const OccupancyGrid& grid, const Checkpoint& checkpoint);
  void requireFewEdges() const;

  const Region* region_;
  Point2d origin_;
  std::vector<ObstacleEdge> edges_;
};

}  // namespace external_command
