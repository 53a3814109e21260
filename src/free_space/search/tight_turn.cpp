// SPDX-License-Identifier: Apache-2.0
#include "tight_turn.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "cell_grid.h"
#include "pose_cells.h"

namespace external_command {

namespace {

constexpr std::array<double, 3> kCellSizes{0.15, 0.1, 0.05};  ///< large ones suffice nearly always [m]
constexpr double kMuchFiner = 0.8;                            ///< cells at least so much smaller can prove more
constexpr double kMaxCells = 1'000'000;
constexpr std::size_t kHeadings = 128;
constexpr double kHeadingCell = 2.0 * M_PI / kHeadings;
constexpr double kCornerShare = 0.4;         ///< of the largest discs, those in the corners
constexpr std::size_t kStatesPerLook = 512;  ///< at the clock
constexpr std::size_t kMaxStates = 400'000;  ///< that are looked at: half a second, at the most
constexpr int kParts = 4;                    ///< of the footprint, one before the other

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

/// Boxes that the footprint covers wherever the axle is within `moved` [m] of a place, and the
/// heading within `turned` [rad]. Those far from the axle are narrower.
std::vector<FootprintBox> partsOf(const FootprintIndex& index, double moved, double turned) {
  const FootprintBox& box = index.box();
  const auto narrowed = [&](double half, double reach_along, double reach_across) {
    return half - moved - turned * reach_across - 0.5 * turned * turned * reach_along;
  };
  const double farthest = std::abs(box.centre) + box.half_length;
  const double half_length = narrowed(box.half_length, farthest, box.half_width);
  std::vector<FootprintBox> parts;
  for (int i = 0; i < kParts; ++i) {
    FootprintBox part = box;
    part.half_length = half_length / kParts;
    part.centre = box.centre - half_length + (2.0 * i + 1.0) * part.half_length;
    part.half_width = narrowed(box.half_width, box.half_width, std::abs(part.centre) + part.half_length);
    if (half_length > 0.0 && part.half_width > 0.0) parts.push_back(part);
  }
  return parts;
}

/// Cells of positions of the rear axle, each with kHeadings cells of headings.
class PoseGrid {
 public:
  PoseGrid(const FootprintIndex& index, const BoundingBox& area, double cell_size)
      : index_(index),
        area_(area),
        reach_(Point2d::Constant(index.box().circumradius() + std::abs(index.box().centre))),
        cells_(area.min - reach_, area.max + reach_, cell_size, kMaxCells) {
    // In a cell the axle is off its middle by half a diagonal, and so is the disc off the middle of its own cell.
    const double off_middle = std::sqrt(2.0) * cells_.cellSize();
    for (Disc disc : discsOf(index)) {
      disc.radius -= off_middle + 0.5 * kHeadingCell * disc.middle.norm();
      if (disc.radius > 0.0) discs_.push_back(disc);
      most_ = std::max(most_, disc.radius);
    }
    parts_ = partsOf(index, M_SQRT1_2 * cells_.cellSize(), 0.5 * kHeadingCell);
    rooms_.assign(static_cast<std::size_t>(cells_.count()), kNotMeasured);
  }

  double cellSize() const { return cells_.cellSize(); }

  /// False where the cells are too large to prove anything.
  bool isFineEnough() const { return !discs_.empty(); }

  bool contains(const Pose2d& pose) const { return cells_.at(pose.position()) >= 0; }

  static std::size_t headingAt(double heading) {
    const auto turned = static_cast<long>(std::floor(heading / kHeadingCell)) % static_cast<long>(kHeadings);
    return static_cast<std::size_t>(turned + static_cast<long>(kHeadings)) % kHeadings;
  }

  static double headingOf(std::size_t heading) {
    return normalizeAngle((static_cast<double>(heading) + 0.5) * kHeadingCell);
  }

  std::size_t stateOf(const Pose2d& pose) const {
    return static_cast<std::size_t>(cells_.at(pose.position())) * kHeadings + headingAt(pose.heading);
  }

  /// All that can be got to from one state, found bit by bit.
  struct Flood {
    int number;
    std::size_t from, to;
    const DistanceMap* map;  ///< of the ways to where it is to get
    std::vector<std::size_t> open;
  };

  Flood begin(int number, std::size_t from, std::size_t to, const DistanceMap& map) {
    flood_at_.set(from, number);
    return {number, from, to, &map, {from}};
  }

  /// Takes a state that is open and marks those beside it. The next one is nearest to where the flood is to get to:
  /// where there is room to turn that takes no time.
  /// @return whether another flood has been there.
  bool grow(Flood* flood) {
    const std::size_t state = flood->open.back();
    flood->open.pop_back();
    bool meets = false;
    steps_.clear();
    forEachBeside(state, [&](std::size_t next) {
      const int other = flood_at_.at(next);
      if (other == flood->number) return;
      if (other != CellNodes::kNone) meets = true;
      if (meets || !mayBeFree(next)) return;
      flood_at_.set(next, flood->number);
      steps_.push_back({next, wayLeft(next, *flood)});
    });
    std::sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.left > b.left; });
    for (const Step& step : steps_) flood->open.push_back(step.state);
    return meets;
  }

  /// By how much the heading is off at least where a flood that is over had to get to.
  TightTurn turnOf(const Flood& flood) const {
    const std::size_t cell = flood.to / kHeadings * kHeadings, wanted = flood.to % kHeadings;
    for (std::size_t off = 1; off <= kHeadings / 2; ++off) {
      for (const std::size_t heading : {wanted + off, wanted + kHeadings - off}) {
        if (flood_at_.at(cell + heading % kHeadings) != flood.number) continue;
        return {static_cast<double>(off - 1) * kHeadingCell};
      }
    }
    return {};
  }

 private:
  struct Step {
    std::size_t state;
    double left;  ///< to the goal, see wayLeft()
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

  /// Metres past the obstacles, and radians.
  double wayLeft(std::size_t state, const Flood& flood) const {
    const Point2d middle = middleOf(state);
    return flood.map->at(middle.x(), middle.y()) +
           std::abs(angleBetween(headingOf(state % kHeadings), headingOf(flood.to % kHeadings)));
  }

  Point2d middleOf(std::size_t state) const { return cells_.centreOf(static_cast<long>(state / kHeadings)); }

  bool mayHoldAxle(const Point2d& middle) const {
    const double half = 0.5 * cells_.cellSize();
    return ((middle - area_.min).array() >= -half).all() && ((area_.max - middle).array() >= -half).all();
  }

  bool mayBeFree(std::size_t state) {
    const Point2d middle = middleOf(state), along = directions()[state % kHeadings];
    if (!mayHoldAxle(middle)) return false;
    const Point2d across(-along.y(), along.x());
    const auto hasRoom = [&](const Disc& disc) {
      const long at = cells_.at(middle + disc.middle.x() * along + disc.middle.y() * across);
      return at < 0 || roomOf(at) >= disc.radius;
    };
    const Frame frame({middle.x(), middle.y(), headingOf(state % kHeadings)});
    const auto meetsEdge = [&](const FootprintBox& part) { return index_.meetsEdge(part, frame); };
    return std::all_of(discs_.begin(), discs_.end(), hasRoom) && std::none_of(parts_.begin(), parts_.end(), meetsEdge);
  }

  /// Rounded to the next larger number that a float can hold, and by that never less than there is.
  double roomOf(long cell) {
    float& room = rooms_[static_cast<std::size_t>(cell)];
    if (room == kNotMeasured) {
      room = std::nextafter(static_cast<float>(index_.axleRoom(cells_.centreOf(cell), most_)),
                            std::numeric_limits<float>::infinity());
    }
    return static_cast<double>(room);
  }

  static const std::array<Point2d, kHeadings>& directions() {
    static const std::array<Point2d, kHeadings> all = [] {
      std::array<Point2d, kHeadings> made;
      for (std::size_t i = 0; i < kHeadings; ++i) made[i] = unitVector(headingOf(i));
      return made;
    }();
    return all;
  }

  static constexpr float kNotMeasured = -std::numeric_limits<float>::infinity();

  const FootprintIndex& index_;
  const BoundingBox area_;  ///< of the axle
  const Point2d reach_;     ///< of the vehicle beyond it [m]
  CellGrid cells_;
  std::vector<Disc> discs_;  ///< as large as is free around the middles of their cells, where a pose of a state is
  std::vector<FootprintBox> parts_;  ///< that the footprint covers from every pose of a state
  double most_ = 0.0;                ///< of their radii [m]
  CellNodes flood_at_;               ///< number of the flood that has been at a state
  std::vector<float> rooms_;         ///< around the middle of each cell, as far as it matters [m]
  std::vector<Step> steps_;
};

/// @param states  that may still be looked at; counted down.
std::optional<TightTurn> turnIn(PoseGrid* grid, const Pose2d& from, const Pose2d& to, const WayMaps& ways,
                                std::size_t* states, const std::function<bool()>& stop) {
  if (!grid->contains(from) || !grid->contains(to) || !grid->isFineEnough()) return std::nullopt;
  const std::size_t first = grid->stateOf(from), last = grid->stateOf(to);
  if (first == last) return std::nullopt;
  std::array<PoseGrid::Flood, 2> floods{grid->begin(0, first, last, ways.to_last),
                                        grid->begin(1, last, first, ways.to_first)};
  for (; *states > 0; --*states) {
    PoseGrid::Flood& flood = floods[*states % 2];
    if (flood.open.empty()) return grid->turnOf(flood);
    if (*states % kStatesPerLook == 0 && stop()) return std::nullopt;
    if (grid->grow(&flood)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<TightTurn> tightTurn(const FootprintIndex& index, const BoundingBox& area, const Pose2d& from,
                                   const Pose2d& to, const WayMaps& ways, const std::function<bool()>& stop) {
  std::size_t states = kMaxStates;
  double coarser = 2.0 * kCellSizes.front();
  for (const double cell_size : kCellSizes) {
    PoseGrid grid(index, area, cell_size);
    if (grid.cellSize() > kMuchFiner * coarser || states == 0 || stop()) break;
    coarser = grid.cellSize();
    if (const auto turn = turnIn(&grid, from, to, ways, &states, stop)) return turn;
  }
  return std::nullopt;
}

}  // namespace external_command
