// SPDX-License-Identifier: Apache-2.0
#include "narrow_passage.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "cell_grid.h"

namespace external_command {

namespace {

constexpr double kCellSize = 0.25;  ///< [m]
constexpr double kMaxCells = 400'000;
constexpr double kTolerance = 2e-3;         ///< to which the widest point of a cell's side is found [m]
constexpr double kSlack = 1e-6;             ///< of a width, for rounding [m]
constexpr std::size_t kCellsPerLook = 256;  ///< at the clock

BoundingBox grown(const BoundingBox& box, double by) {
  return {box.min - Point2d::Constant(by), box.max + Point2d::Constant(by)};
}

/// A grid of square cells. The disc's middle gets from cell to cell through their common side, somewhere on which the
/// disc must be free; within a cell nothing is asked.
class PassageGrid {
 public:
  PassageGrid(const FootprintIndex& index, const BoundingBox& area)
      : index_(index),
        radius_(index.bodyDisc()),
        ahead_(index.bodyDiscAhead()),
        bounds_(grown(index.axleBounds(), std::abs(ahead_))),
        cells_(area.min - Point2d::Constant(std::abs(ahead_)), area.max + Point2d::Constant(std::abs(ahead_)),
               kCellSize, kMaxCells) {}

  /// Of the disc's middle.
  long cellAt(const Pose2d& pose) const { return cells_.at(pose.position() + ahead_ * unitVector(pose.heading)); }

  /// True, too, once `stop` says so.
  bool connects(long from, long to, const std::function<bool()>& stop) const {
    std::vector<bool> is_seen(static_cast<std::size_t>(cells_.count()));
    std::vector<long> open{from};
    is_seen[static_cast<std::size_t>(from)] = true;
    for (std::size_t looked = 0; !open.empty(); ++looked) {
      const long cell = open.back();
      open.pop_back();
      if (cell == to || (looked % kCellsPerLook == 0 && stop())) return true;
      cells_.forEachBeside(cell, [&](long next, const Point2d& a, const Point2d& b) {
        if (is_seen[static_cast<std::size_t>(next)] || !letsPass(a, b)) return;
        is_seen[static_cast<std::size_t>(next)] = true;
        open.push_back(next);
      });
    }
    return false;
  }

  /// A point of a way, and the radius of the disc that is free there [m].
  struct Spot {
    Point2d at;
    double room;
  };

  /// The least roomy point of the roomiest way (a widest-path search); nullopt if there is none, or stopped.
  std::optional<Spot> narrowest(long from, long to, const std::function<bool()>& stop) const {
    struct Entry {
      double room;
      long cell;
      bool operator<(const Entry& other) const { return room < other.room; }
    };
    std::vector<double> rooms(static_cast<std::size_t>(cells_.count()), -1.0);
    std::vector<Point2d> places(rooms.size(), cells_.centreOf(from));
    std::priority_queue<Entry> open;
    rooms[static_cast<std::size_t>(from)] = std::numeric_limits<double>::infinity();
    open.push({rooms[static_cast<std::size_t>(from)], from});
    while (!open.empty()) {
      const Entry here = open.top();
      open.pop();
      if (here.cell == to) return Spot{places[static_cast<std::size_t>(to)], here.room};
      if (here.room <= kTolerance || stop()) return std::nullopt;
      const auto at = static_cast<std::size_t>(here.cell);
      if (here.room < rooms[at]) continue;
      cells_.forEachBeside(here.cell, [&](long next, const Point2d& a, const Point2d& b) {
        const auto there = static_cast<std::size_t>(next);
        if (rooms[there] >= here.room) return;
        Point2d place = a;
        const double side = widest(a, b, &place);
        const double room = std::min(here.room, side);
        if (room <= rooms[there]) return;
        rooms[there] = room;
        places[there] = side < here.room ? place : places[at];
        open.push({room, next});
      });
    }
    return std::nullopt;
  }

 private:
  bool isInBounds(const Point2d& point) const {
    return (point.array() >= bounds_.min.array()).all() && (point.array() <= bounds_.max.array()).all();
  }

  /// Whether the disc is free somewhere on the side. Room changes by no more than the distance moved, so a middle
  /// without enough of it tells about a stretch to either side.
  bool letsPass(const Point2d& a, const Point2d& b) const {
    const Point2d middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a).norm();
    const bool is_in_bounds = isInBounds(middle);
    if (is_in_bounds) {
      const double room = index_.axleRoom(middle, radius_);
      if (room >= radius_ - kSlack) return true;
      if (room + half < radius_ - kSlack) return false;
    }
    if (half < kTolerance) return is_in_bounds;
    return letsPass(a, middle) || letsPass(middle, b);
  }

  double roomAt(const Point2d& point) const {
    if (!isInBounds(point)) return 0.0;
    const double room = index_.axleRoom(point, radius_);
    return room > 0.0 && room < radius_ && index_.obstacles().filledBy(point) ? -room : room;
  }

  double widest(const Point2d& a, const Point2d& b, Point2d* place) const {
    const Point2d middle = 0.5 * (a + b);
    const double half = 0.5 * (b - a).norm();
    double best = roomAt(middle);
    *place = middle;
    if (half < kTolerance) return best;
    for (const auto& [from, to] : {std::pair{a, middle}, std::pair{middle, b}}) {
      const Point2d centre = 0.5 * (from + to);
      if (roomAt(centre) + 0.5 * half <= std::max(best, kTolerance)) continue;
      Point2d other = centre;
      const double room = widest(from, to, &other);
      if (room > best) best = room, *place = other;
    }
    return best;
  }

  const FootprintIndex& index_;
  double radius_;
  double ahead_;        ///< of the rear axle, where the disc's middle is [m]
  BoundingBox bounds_;  ///< of that
  CellGrid cells_;
};

/// The line across `place` that leaves least beyond the margins at its ends.
NarrowPassage measured(const FootprintIndex& index, const Point2d& place) {
  struct End {
    Point2d at;
    double margin;
  };
  const std::vector<ObstacleEdge>& edges = index.obstacles().edges();
  const auto nearest = [&](const std::function<bool(const Point2d&)>& counts) {
    End best{place, index.margin()};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const Point2d point = nearestOnSegment(place, edges[i].begin, edges[i].end);
      const double room = (point - place).norm() - index.marginTo(i);
      if (room < least && counts(point)) best = {point, index.marginTo(i)}, least = room;
    }
    return best;
  };
  const End one = nearest([](const Point2d&) { return true; });
  const Point2d towards = one.at - place;
  const End other = nearest([&](const Point2d& point) { return (point - place).dot(towards) < 0.0; });
  return {(one.at - other.at).norm(), one.margin + other.margin, 0.5 * (one.at + other.at)};
}

}  // namespace

bool isTooNarrow(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from, const Pose2d& to,
                 const std::function<bool()>& stop) {
  const PassageGrid grid(index, area);
  const long first = grid.cellAt(from), last = grid.cellAt(to);
  return first >= 0 && last >= 0 && !grid.connects(first, last, stop);
}

std::optional<NarrowPassage> narrowestPassage(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                              const Pose2d& to, const std::function<bool()>& stop) {
  const PassageGrid grid(index, area);
  const long first = grid.cellAt(from), last = grid.cellAt(to);
  if (first < 0 || last < 0) return std::nullopt;
  const auto spot = grid.narrowest(first, last, stop);
  if (!spot) return std::nullopt;
  const NarrowPassage passage = measured(index, spot->at);
  return passage.width > kTolerance ? std::optional(passage) : std::nullopt;
}

}  // namespace external_command
