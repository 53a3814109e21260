// SPDX-License-Identifier: Apache-2.0
#include "collision_probe.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr int kDirections = 32;      ///< in which a way out of an obstacle is looked for
constexpr double kFarthest = 64.0;   ///< [m]
constexpr double kDepthStep = 1e-3;  ///< [m]

Collision::Kind kindOf(int source) {
  if (source == kDrivableSource) return Collision::Kind::kDrivableBorder;
  return source == kGridSource ? Collision::Kind::kGrid : Collision::Kind::kNonDrivable;
}

/// Slow and plain: one pose against all the edges of one obstacle that it could meet.
class Probe {
 public:
  Probe(const FootprintIndex& index, const Pose2d& pose) : index_(index), pose_(pose) {
    const std::vector<ObstacleEdge>& edges = index_.obstacles().edges();
    const double reach = kFarthest + index_.box().circumradius() + std::abs(index_.box().centre) + index_.margin();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Point2d nearest = nearestOnSegment(pose.position(), edges[i].begin, edges[i].end);
      if ((nearest - pose.position()).norm() <= reach) near_[edges[i].source].push_back(i);
    }
  }

  /// True where the footprint, moved by `shift`, comes nearer than the margin to `source`.
  bool collides(int source, const Point2d& shift) const {
    const Frame frame = shifted(shift);
    const std::vector<ObstacleEdge>& edges = index_.obstacles().edges();
    if (const auto near = near_.find(source); near != near_.end()) {
      for (const std::size_t i : near->second) {
        if (index_.isTooNear(index_.distanceTo(edges[i], frame), i)) return true;
      }
    }
    const double c = index_.box().centre;
    return index_.obstacles().isFilledBy(source, {frame.x + c * frame.cos, frame.y + c * frame.sin});
  }

  /// Shortest of the straight ways out of `source`.
  double depth(int source) const {
    double best = kFarthest;
    for (int i = 0; i < kDirections; ++i) {
      const Point2d way = unitVector(pose_.heading + 2.0 * M_PI * i / kDirections);
      double low = 0.0, high = 0.01;
      while (high < best && collides(source, high * way)) low = high, high *= 2.0;
      if (high >= best && collides(source, best * way)) continue;
      high = std::min(high, best);
      while (high - low > kDepthStep) {
        const double middle = 0.5 * (low + high);
        (collides(source, middle * way) ? low : high) = middle;
      }
      best = high;
    }
    return best;
  }

  /// A point of `source` nearest to the footprint's centre.
  Point2d nearestPoint(int source) const {
    const Frame frame = shifted({0.0, 0.0});
    const Point2d centre(frame.x + index_.box().centre * frame.cos, frame.y + index_.box().centre * frame.sin);
    Point2d best = centre;
    double best_distance = std::numeric_limits<double>::infinity();
    for (const ObstacleEdge& edge : index_.obstacles().edges()) {
      if (edge.source != source) continue;
      const Point2d point = nearestOnSegment(centre, edge.begin, edge.end);
      if ((point - centre).norm() < best_distance) best = point, best_distance = (point - centre).norm();
    }
    return best;
  }

 private:
  Frame shifted(const Point2d& shift) const { return Frame({pose_.x + shift.x(), pose_.y + shift.y(), pose_.heading}); }

  const FootprintIndex& index_;
  Pose2d pose_;
  std::map<int, std::vector<std::size_t>> near_;  ///< edges that the footprint could meet, of each source
};

/// The obstacles that may be met, one source each.
std::vector<int> sourcesOf(const Region& region) {
  std::vector<int> sources;
  if (region.drivable()) sources.push_back(kDrivableSource);
  if (region.grid()) sources.push_back(kGridSource);
  for (std::size_t i = 0; i < region.nonDrivable().size(); ++i) sources.push_back(static_cast<int>(i));
  return sources;
}

}  // namespace

std::string Collision::extent() const {
  return depth < kFarthest ? "by " + metres(depth) : "by more than " + metres(kFarthest);
}

std::string Collision::description() const {
  const bool is_border = kind == Kind::kDrivableBorder || kind == Kind::kAxleBounds;
  return text(is_border ? "sticks out of " : "overlaps ", obstacle, " ", extent());
}

std::string obstacleName(const Region& region, int source) {
  if (source == kGridSource) return "the obstacle grid";
  return source == kDrivableSource ? region.drivable()->name()
                                   : region.nonDrivable()[static_cast<std::size_t>(source)].name();
}

std::optional<Collision> probeCollision(const FootprintIndex& index, const Pose2d& local) {
  if (index.isFree(local)) return std::nullopt;
  const Point2d origin = index.obstacles().origin();
  if (!index.isWithinAxleBounds(local.x, local.y)) {
    const BoundingBox& box = index.axleBounds();
    const Point2d inside = local.position().cwiseMax(box.min).cwiseMin(box.max);
    return Collision{Collision::Kind::kAxleBounds, 0, "the axle bounds", (inside - local.position()).norm(),
                     inside + origin};
  }
  const Region& region = index.obstacles().region();
  const Probe probe(index, local);
  std::optional<Collision> deepest;
  for (const int source : sourcesOf(region)) {
    if (!probe.collides(source, {0.0, 0.0})) continue;
    const double depth = probe.depth(source);
    if (deepest && deepest->depth >= depth) continue;
    deepest = Collision{kindOf(source), static_cast<std::size_t>(std::max(source, 0)), obstacleName(region, source),
                        depth, probe.nearestPoint(source) + origin};
  }
  return deepest;
}

}  // namespace external_command
