// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "external_command/core/vehicle.h"
#include "external_command/motion/reeds_shepp.h"
#include "obstacle_edges.h"

namespace external_command {

/// A piece of an arc in the frame in which it begins. To drive several of the same costs far less than as many poses
/// do: no angle is taken.
struct Stride {
  double forward, left;  ///< of its end [m]
  double cos, sin;       ///< of the turn

  /// @param length  negative in reverse [m]
  Stride(double kappa, double length) {
    const double half_turn = 0.5 * kappa * length, c = std::cos(half_turn), s = std::sin(half_turn);
    const double chord = std::abs(half_turn) < 1e-9 ? length : length * s / half_turn;
    forward = chord * c, left = chord * s;
    cos = c * c - s * s, sin = 2.0 * s * c;
  }
};

/// A pose with its heading as a unit vector, for loops that step along an arc.
struct Frame {
  double x, y, cos, sin;

  explicit Frame(const Pose2d& pose) : x(pose.x), y(pose.y), cos(std::cos(pose.heading)), sin(std::sin(pose.heading)) {}

  void drive(const Stride& stride) {
    x += cos * stride.forward - sin * stride.left;
    y += sin * stride.forward + cos * stride.left;
    const double c = cos * stride.cos - sin * stride.sin;
    sin = sin * stride.cos + cos * stride.sin;
    cos = c;
  }
};

/// The vehicle's rectangle seen from its centre.
struct FootprintBox {
  explicit FootprintBox(const VehicleParams& vehicle)
      : centre((vehicle.wheelbase + vehicle.front_overhang - vehicle.rear_overhang) / 2.0),
        half_length(vehicle.length() / 2.0),
        half_width(vehicle.width / 2.0) {}

  double circumradius() const { return std::hypot(half_length, half_width); }

  /// Most that any corner moves [m] for a metre driven at curvature `kappa`.
  double cornerSpeed(double kappa) const {
    return std::hypot(1.0 + std::abs(kappa) * half_width, kappa * (std::abs(centre) + half_length));
  }

  double centre;  ///< ahead of the rear axle [m]
  double half_length;
  double half_width;
};

/// Where the margin is smaller, since a pose that has to be taken is nearer to an obstacle.
struct EasedMargin {
  std::size_t pose = 0;   ///< index of that pose
  double distance = 0.0;  ///< of its bare footprint from the nearest obstacle [m]
  int source = 0;         ///< that obstacle, see ObstacleEdge
  double margin = 0.0;    ///< to it, half of that distance [m]
  double within = 0.0;    ///< of the footprint's centre at that pose [m]
};

/// Decides whether the footprint is free of obstacles, in the local frame. Edges lie in the cells of a coarse grid from
/// which the footprint could reach them, and each cell knows its distance to the nearest edge: far from all edges one
/// look-up answers, near them the few edges of the cell are tested exactly. Immutable and thread-safe.
class FootprintIndex {
 public:
  /// @param eased_at    poses (local frame) that have to be taken. Those obstacles that one of them is nearer to than
  ///                    the margin, without meeting them, may be approached to half of that distance nearby.
  /// @param checkpoint  called now and then while the index is made: a large region takes a second.
  /// @throws InvalidRequest  the region has more edges than RegionLimits allow.
  FootprintIndex(const VehicleParams& vehicle, double margin, const Region& region, const Point2d& origin,
                 const std::vector<Pose2d>& eased_at, const Checkpoint& checkpoint);

  const LocalObstacles& obstacles() const { return obstacles_; }
  const FootprintBox& box() const { return box_; }
  double margin() const { return margin_; }
  const std::vector<EasedMargin>& easedMargins() const { return eased_; }

  /// Negative where the footprint comes nearer than the margin to an obstacle or leaves the axle bounds. Else a lower
  /// bound of how far every corner can move before it does [m]; often 0.
  double freeRadius(const Frame& frame) const;

  /// As freeRadius(), but beside obstacles it is the distance itself, up to kBeyond [m].
  double exactRoom(const Frame& frame) const;

  bool isFree(const Pose2d& pose) const { return freeRadius(Frame(pose)) >= 0.0; }

  /// How far [m] `arc` can be driven from `from` with every checked pose free; the whole length if nothing is in the
  /// way. Between two checks no corner moves more than `step` [m]. `from` itself is not checked.
  double freeLength(const Pose2d& from, const ArcSegment& arc, double step) const;

  /// Whether all of `arc` keeps the margin, nowhere missing more than a millimetre of it: each step is as long as the
  /// distance to the obstacles allows. `from` itself is not checked.
  bool keepsMargin(const Pose2d& from, const ArcSegment& arc) const;

  /// How near the footprint is to what is around it.
  struct Clearance {
    double distance;  ///< from the bare footprint to the nearest edge or filled point [m]
    double room;      ///< smallest difference of distance and margin; negative where a margin is broken [m]
  };

  /// Both are at most `limit`.
  Clearance clearance(const Frame& frame, double limit) const;

  /// Whether a distance between footprint and edge breaks the margin, but for rounding. Touching always does.
  bool isTooNear(double distance, std::size_t edge) const {
    return distance <= 0.0 || distance < marginTo(edge) - 1e-9;
  }

  /// Distance [m] from the bare footprint to `edge`; 0 where they meet.
  double distanceTo(const ObstacleEdge& edge, const Frame& frame) const;

  const BoundingBox& axleBounds() const { return axle_bounds_; }
  bool isWithinAxleBounds(double x, double y) const;

  /// False only where no free footprint has its rear-axle centre within `radius` [m] of the point.
  bool axleMayBeWithin(double x, double y, double radius) const;

  /// Whether an edge comes nearer than its margin to a part of the footprint of a vehicle at `frame`. Beside a corner
  /// of the part it may come somewhat nearer before it counts.
  bool meetsEdge(const FootprintBox& part, const Frame& frame) const;

  /// Radius of the disc around the rear axle's middle that every free footprint contains, with the margin [m].
  double axleDisc() const { return std::min(box_.half_width, box_.half_length - std::abs(box_.centre)) + margin_; }

  /// Radius of the largest discs that fit into every free footprint, with the margin [m]; and how far ahead of the rear
  /// axle the middle of that one is which is nearest to it [m].
  double bodyDisc() const { return std::min(box_.half_width, box_.half_length) + margin_; }
  double bodyDiscAhead() const {
    const double reach = std::max(box_.half_length - box_.half_width, 0.0);
    return std::clamp(0.0, box_.centre - reach, box_.centre + reach);
  }

  /// Distance from the point to the nearest edge, at most `limit`, which must not exceed bodyDisc(). An edge whose
  /// margin is smaller counts as so much farther away: a disc with the margin all around fits where the room is no less
  /// than its radius. Deep inside an obstacle it is negative, at most that depth [m].
  double axleRoom(const Point2d& point, double limit) const;

  /// To an edge [m].
  double marginTo(std::size_t edge) const { return margins_.empty() ? margin_ : margins_[edge]; }

  /// At most the distance from the middle of the point's cell to the nearest obstacle; 0 in one [m].
  double roomAt(const Point2d& point) const;

  /// Distance from the point to the nearest obstacle, interpolated between the middles of the cells around it: exact
  /// beside a straight edge within the footprint's reach, else rather too small; 0 in an obstacle [m].
  double roomBetweenCells(const Point2d& point) const;

  /// Side of a cell [m], and the corner of the cell that holds `point`: maps made of the same cells get the sharpest
  /// answers.
  double cellSize() const { return cell_size_; }
  Point2d snapped(const Point2d& point) const;

  /// Box around everything that matters: edges, cut to the axle bounds. Empty (min > max) without either.
  const BoundingBox& extent() const { return extent_; }

 private:
  static constexpr double kBeyond =
      0.25;  ///< edges are listed this far beyond the reach, so that room can be measured [m]

  static constexpr std::size_t kBlock = 16;

  enum class State : std::uint8_t { kFree, kFilled };

  /// An edge as middle and half, which is what the separating axes need.
  struct HalfEdge {
    double mx, my, hx, hy;

    HalfEdge(const Point2d& begin, const Point2d& end)
        : mx(0.5 * (begin.x() + end.x())),
          my(0.5 * (begin.y() + end.y())),
          hx(0.5 * (end.x() - begin.x())),
          hy(0.5 * (end.y() - begin.y())) {}

    double distanceFrom(const Point2d& point) const {
      const double dx = point.x() - mx, dy = point.y() - my;
      const double t = std::clamp((dx * hx + dy * hy) / std::max(hx * hx + hy * hy, 1e-18), -1.0, 1.0);
      return std::sqrt((dx - t * hx) * (dx - t * hx) + (dy - t * hy) * (dy - t * hy));
    }
  };

  /// Short edges of one obstacle that follow each other, [first, last), all within `radius` [m] of a core; or a single
  /// edge, which is its own core. Finely drawn obstacles have fewer groups than edges.
  struct EdgeGroup {
    HalfEdge core;
    double radius;
    std::uint32_t first, last;
  };

  /// How far the edges of a group may reach [m], and how many they may be.
  struct GroupSize {
    double extent;
    std::size_t edges;
  };

  /// Some edges of one obstacle that follow each other, [first, last), in a box: middle and half of its diagonal.
  struct Block {
    HalfEdge box;
    std::uint32_t first, last;
  };

  /// The blocks [first, last) in a box. Those of more than one block have two halves: the first follows at once.
  struct BlockNode {
    HalfEdge box;
    std::uint32_t first, last, second_half;
  };

  struct CellGroup {
    std::uint32_t cell, group;
  };

  /// Numbers of groups.
  struct GroupList {
    const std::uint32_t *first, *last;
    const std::uint32_t* begin() const { return first; }
    const std::uint32_t* end() const { return last; }
  };

  /// Those that the footprint can reach from a cell.
  GroupList groupsNear(long cell) const {
    const auto at = static_cast<std::size_t>(cell);
    return {listed_.data() + starts_[at], listed_.data() + starts_[at + 1]};
  }

  double easedBy(std::size_t edge) const { return margin_ - marginTo(edge); }
  double roomWithin(long cell, const Point2d& point, double limit) const;
  void easeMargin(std::size_t number, const Pose2d& pose);
  void easeEdge(std::size_t edge, const Point2d& centre, const EasedMargin& eased);
  void makeBlocks();
  void addBlockNode(std::uint32_t first, std::uint32_t last);
  template <class IsNear, class Visit>
  void forEachBlock(const IsNear& is_near, const Visit& visit) const;
  bool isFilled(const Point2d& point) const;
  void setExtent();
  void fillStates(const Checkpoint& checkpoint);
  void fillPolygon(const Polygon& polygon, bool inside, const Checkpoint& checkpoint);
  void spreadEdges(const Checkpoint& checkpoint);
  void makeGroups(const GroupSize& most);
  void addGroup(std::uint32_t first, std::uint32_t last);
  bool spreadGroups(std::size_t most, std::vector<CellGroup>* pairs, const Checkpoint& checkpoint);
  void spread(std::uint32_t group, std::vector<CellGroup>* pairs);
  void list(const std::vector<CellGroup>& pairs, const Checkpoint& checkpoint);
  void extendNear();
  double listReach() const { return reach_ + cell_reach_ + kBeyond; }
  long cellAt(double x, double y) const;
  Point2d cellCentre(long column, long row) const;
  bool edgesAreClear(long cell, const Frame& frame, double cx, double cy) const;
  bool edgesAreClear(const EdgeGroup& group, const Frame& frame, double cx, double cy) const;
  bool isFilled(long cell, const Point2d& point) const;
  double exactDistance(const HalfEdge& edge, const Frame& frame, double cx, double cy) const;

  LocalObstacles obstacles_;
  FootprintBox box_;
  double margin_;
  std::vector<EasedMargin> eased_;
  std::vector<double> margins_;  ///< to each edge [m]; empty: the same to all
  double reach_;                 ///< edges farther from the footprint's centre cannot break the margin [m]
  BoundingBox extent_;
  BoundingBox axle_bounds_;
  bool outside_is_free_;
  double cell_size_ = 0.5;
  double cell_reach_ = 0.0;  ///< half the diagonal of a cell [m]
  long columns_ = 0;
  long rows_ = 0;
  std::vector<HalfEdge> edges_;
  std::vector<EdgeGroup> groups_;
  std::vector<Block> blocks_;           ///< side by side as far as may be
  std::vector<BlockNode> block_nodes_;  ///< from the whole down
  std::vector<State> states_;           ///< at the centre of each cell
  std::vector<float> near_;             ///< at most the distance from each cell's centre to the nearest edge [m]
  std::vector<std::uint32_t> starts_;   ///< of each cell's part of `listed_`
  std::vector<std::uint32_t> listed_;   ///< groups by cell
};

}  // namespace external_command
