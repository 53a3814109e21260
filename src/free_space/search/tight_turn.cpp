// SPDX-License-Identifier: Apache-2.0
#include "tight_turn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "cell_grid.h"

namespace external_command {

namespace {

constexpr double kCellSize = 0.05;  ///< [m]
constexpr double kMaxCells = 200'000;
constexpr std::size_t kHeadings = 128;
constexpr double kHeadingCell = 2.0 * M_PI / kHeadings;
constexpr double kCornerShare = 0.4;         ///< of the largest discs, those in the corners
constexpr std::size_t kStatesPerLook = 512;  ///< at the clock

/// A disc inside the footprint, with the margin.
struct Disc {
  Point2d middle;  ///< ahead and to the left of the rear axle [m]
  double radius;   ///< [m]
};

/// Along the middle, so that nothing fits between them, and in the corners.
std::vector<Disc> discsOf(const FootprintIndex& index) {
  const FootprintBox& box = index.box();
  const double inside = std::min(box.half_length, box.half_width);
  const double radius = index.bodyDisc(), reach = box.half_length - inside;
  std::vector<Disc> discs;
  const double count = std::ceil(reach / inside) + 1.0;
  for (double i = 0.0; i < count; ++i) discs.push_back({{box.centre - reach + 2.0 * reach * i / count, 0.0}, radius});
  discs.push_back({{box.centre + reach, 0.0}, radius});
  const double corner = kCornerShare * inside, margin = radius - inside;
  for (const double end : {-1.0, 1.0}) {
    for (const double side : {-1.0, 1.0}) {
      discs.push_back(
          {{box.centre + end * (box.half_length - corner), side * (box.half_width - corner)}, corner + margin});
    }
  }
  return discs;
}

/// Cells of positions of the rear axle, each with kHeadings cells of headings.
class PoseGrid {
 public:
  PoseGrid(const FootprintIndex& index, const BoundingBox& area)
      : index_(index),
        area_(area),
        reach_(Point2d::Constant(index.box().circumradius() + std::abs(index.box().centre))),
        cells_(area.min - reach_, area.max + reach_, kCellSize, kMaxCells) {
    // In a cell the axle is off its middle by half a diagonal, and so is the disc off the middle of its own cell.
    const double off_middle = std::sqrt(2.0) * cells_.cellSize();
    for (Disc disc : discsOf(index)) {
      disc.radius -= off_middle + 0.5 * kHeadingCell * disc.middle.norm();
      if (disc.radius > 0.0) discs_.push_back(disc);
      most_ = std::max(most_, disc.radius);
    }
    rooms_.assign(static_cast<std::size_t>(cells_.count()), kNotMeasured);
  }

  /// False where the cells are too large to prove anything.
  bool isFineEnough() const { return !discs_.empty(); }

  long cellAt(const Point2d& point) const { return cells_.at(point); }

  static std::size_t headingAt(double heading) {
    const auto turned = static_cast<long>(std::floor(heading / kHeadingCell)) % static_cast<long>(kHeadings);
    return static_cast<std::size_t>(turned + static_cast<long>(kHeadings)) % kHeadings;
  }

  static double headingOf(std::size_t heading) {
    return normalizeAngle((static_cast<double>(heading) + 0.5) * kHeadingCell);
  }

  /// Marks all states that can be got to from one; false where `stop` ended that, or `to` is among them. Goes towards
  /// `to` first: where there is room to turn that takes no time.
  bool flood(std::size_t from, std::size_t to, const std::function<bool()>& stop) {
    is_seen_.assign(static_cast<std::size_t>(cells_.count()) * kHeadings, false);
    std::vector<std::size_t> open{from};
    is_seen_[from] = true;
    std::vector<Step> steps;
    for (std::size_t looked = 0; !open.empty(); ++looked) {
      const std::size_t state = open.back();
      open.pop_back();
      if (state == to || (looked % kStatesPerLook == 0 && stop())) return false;
      steps.clear();
      forEachBeside(state, [&](std::size_t next) {
        if (is_seen_[next] || !mayBeFree(next)) return;
        is_seen_[next] = true;
        steps.push_back({next, distance(next, to)});
      });
      std::sort(steps.begin(), steps.end(), [](const Step& a, const Step& b) { return a.left > b.left; });
      for (const Step& step : steps) open.push_back(step.state);
    }
    return true;
  }

  bool isSeen(std::size_t state) const { return is_seen_[state]; }

 private:
  struct Step {
    std::size_t state;
    double left;  ///< to the goal, see distance()
  };

  template <class Visit>
  void forEachBeside(std::size_t state, const Visit& visit) const {
    const std::size_t cell = state / kHeadings, heading = state % kHeadings;
    visit(cell * kHeadings + (heading + 1) % kHeadings);
    visit(cell * kHeadings + (heading + kHeadings - 1) % kHeadings);
    cells_.forEachBeside(static_cast<long>(cell), [&](long next, const Point2d& /*a*/, const Point2d& /*b*/) {
      visit(static_cast<std::size_t>(next) * kHeadings + heading);
    });
  }

  /// Metres, and radians.
  double distance(std::size_t a, std::size_t b) const {
    const Point2d between = middleOf(a) - middleOf(b);
    return between.norm() + std::abs(angleBetween(headingOf(a % kHeadings), headingOf(b % kHeadings)));
  }

  Point2d middleOf(std::size_t state) const { return cells_.centreOf(static_cast<long>(state / kHeadings)); }

  bool mayHoldAxle(const Point2d& middle) const {
    const double half = 0.5 * cells_.cellSize();
    return ((middle - area_.min).array() >= -half).all() && ((area_.max - middle).array() >= -half).all();
  }

  bool mayBeFree(std::size_t state) {
    const Point2d middle = middleOf(state), along = directions()[state % kHeadings];
    if (!mayHoldAxle(middle)) return false;
    return std::all_of(discs_.begin(), discs_.end(), [&](const Disc& disc) {
      const Point2d across(-along.y(), along.x());
      const long at = cells_.at(middle + disc.middle.x() * along + disc.middle.y() * across);
      return at < 0 || roomOf(at) >= disc.radius;
    });
  }

  double roomOf(long cell) {
    double& room = rooms_[static_cast<std::size_t>(cell)];
    if (room == kNotMeasured) room = index_.axleRoom(cells_.centreOf(cell), most_);
    return room;
  }

  static const std::array<Point2d, kHeadings>& directions() {
    static const std::array<Point2d, kHeadings> all = [] {
      std::array<Point2d, kHeadings> made;
      for (std::size_t i = 0; i < kHeadings; ++i) made[i] = unitVector(headingOf(i));
      return made;
    }();
    return all;
  }

  static constexpr double kNotMeasured = -std::numeric_limits<double>::infinity();

  const FootprintIndex& index_;
  const BoundingBox area_;  ///< of the axle
  const Point2d reach_;     ///< of the vehicle beyond it [m]
  CellGrid cells_;
  std::vector<Disc> discs_;    ///< as large as is free around the middles of their cells, where a pose of a state is
  double most_ = 0.0;          ///< of their radii [m]
  std::vector<double> rooms_;  ///< around the middle of each cell, as far as it matters [m]
  std::vector<bool> is_seen_;
};

}  // namespace

std::optional<TightTurn> tightTurn(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                   const Pose2d& to, const std::function<bool()>& stop) {
  PoseGrid grid(index, area);
  const long first = grid.cellAt(from.position()), last = grid.cellAt(to.position());
  if (first < 0 || last < 0 || !grid.isFineEnough()) return std::nullopt;
  const auto stateOf = [](long cell, std::size_t heading) {
    return static_cast<std::size_t>(cell) * kHeadings + heading;
  };
  const std::size_t wanted = PoseGrid::headingAt(to.heading);
  if (!grid.flood(stateOf(first, PoseGrid::headingAt(from.heading)), stateOf(last, wanted), stop)) return std::nullopt;
  for (std::size_t off = 1; off <= kHeadings / 2; ++off) {
    if (grid.isSeen(stateOf(last, (wanted + off) % kHeadings)) ||
        grid.isSeen(stateOf(last, (wanted + kHeadings - off) % kHeadings))) {
      return TightTurn{static_cast<double>(off - 1) * kHeadingCell};
    }
  }
  return TightTurn{};
}

}  // namespace external_command
