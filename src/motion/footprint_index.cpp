// SPDX-License-Identifier: Apache-2.0
#include "footprint_index.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace external_command {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kCellSize = 0.5;  ///< [m]
constexpr double kMaxCells = 500'000.0;
constexpr long kRowsAtOnce = 16;    ///< between two checkpoints
constexpr double kFineStep = 2e-3;  ///< most that a corner moves between two checks where there is no room [m]

BoundingBox emptyBox() { return {Point2d(kInfinity, kInfinity), Point2d(-kInfinity, -kInfinity)}; }

double squared(double a) { return a * a; }

/// Whether the edge of middle (mu, mv) and half (hu, hv) meets the box [-l, l] x [-w, w]: by their separating axes.
bool boxMeets(double mu, double mv, double hu, double hv, double l, double w) {
  return std::abs(mu) <= l + std::abs(hu) && std::abs(mv) <= w + std::abs(hv) &&
         std::abs(mu * hv - mv * hu) <= l * std::abs(hv) + w * std::abs(hu);
}

/// Squared distance from (u, v) to the box [-l, l] x [-w, w].
double pointToBox(double u, double v, double l, double w) {
  return squared(std::max(std::abs(u) - l, 0.0)) + squared(std::max(std::abs(v) - w, 0.0));
}

}  // namespace

FootprintIndex::FootprintIndex(const VehicleParams& vehicle, double margin, const Region& region, const Point2d& origin,
                               const std::vector<Pose2d>& eased_at, const Checkpoint& checkpoint)
    : obstacles_(region, origin, checkpoint),
      box_(vehicle),
      margin_(margin),
      reach_(box_.circumradius() + margin),
      extent_(emptyBox()),
      axle_bounds_{Point2d(-kInfinity, -kInfinity), Point2d(kInfinity, kInfinity)},
      outside_is_free_(!obstacles_.isOutsideFilled()) {
  if (region.axleBounds()) axle_bounds_ = {region.axleBounds()->min - origin, region.axleBounds()->max - origin};
  for (std::size_t i = 0; i < eased_at.size(); ++i) easeMargin(i, eased_at[i]);
  for (const ObstacleEdge& edge : obstacles_.edges()) {
    edges_.emplace_back(edge.begin, edge.end);
  }
  makeBlocks();
  setExtent();
  fillStates(checkpoint);
  spreadEdges(checkpoint);
  checkpoint();
  extendNear();
}

void FootprintIndex::setExtent() {
  for (const ObstacleEdge& edge : obstacles_.edges()) {
    extent_.min = extent_.min.cwiseMin(edge.begin).cwiseMin(edge.end);
    extent_.max = extent_.max.cwiseMax(edge.begin).cwiseMax(edge.end);
  }
  if (edges_.empty()) return;
  const double pad = reach_ + std::abs(box_.centre);
  extent_.min = extent_.min.cwiseMax(axle_bounds_.min - Point2d(pad, pad));
  extent_.max = extent_.max.cwiseMin(axle_bounds_.max + Point2d(pad, pad));
  const Point2d size = (extent_.max - extent_.min).cwiseMax(0.0) + 2.0 * Point2d(reach_, reach_);
  cell_size_ = std::max(kCellSize, std::sqrt(size.x() * size.y() / kMaxCells));
  cell_reach_ = cell_size_ * M_SQRT1_2;
  columns_ = static_cast<long>(size.x() / cell_size_) + 1;
  rows_ = static_cast<long>(size.y() / cell_size_) + 1;
}

Point2d FootprintIndex::cellCentre(long column, long row) const {
  return extent_.min - Point2d(reach_, reach_) +
         cell_size_ * Point2d(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
}

long FootprintIndex::cellAt(double x, double y) const {
  const double column = (x - extent_.min.x() + reach_) / cell_size_, row = (y - extent_.min.y() + reach_) / cell_size_;
  if (!(column >= 0.0 && row >= 0.0 && column < static_cast<double>(columns_) && row < static_cast<double>(rows_))) {
    return -1;
  }
  return static_cast<long>(row) * columns_ + static_cast<long>(column);
}

void FootprintIndex::fillStates(const Checkpoint& checkpoint) {
  states_.assign(static_cast<std::size_t>(columns_ * rows_), State::kFree);
  const Region& region = obstacles_.region();
  if (region.drivable()) fillPolygon(*region.drivable(), false, checkpoint);
  for (const Polygon& polygon : region.nonDrivable()) fillPolygon(polygon, true, checkpoint);
  if (!region.grid()) return;
  for (long row = 0; row < rows_; ++row) {
    checkpoint();
    for (long column = 0; column < columns_; ++column) {
      State& state = states_[static_cast<std::size_t>(row * columns_ + column)];
      if (obstacles_.isFilledBy(kGridSource, cellCentre(column, row))) state = State::kFilled;
    }
  }
}

/// Marks the cells whose centre lies inside (or outside) the polygon, row by row (even-odd rule).
void FootprintIndex::fillPolygon(const Polygon& polygon, bool inside, const Checkpoint& checkpoint) {
  const std::vector<Point2d>& points = polygon.points();
  std::vector<double> crossings;
  for (long row = 0; row < rows_; ++row) {
    if (row % kRowsAtOnce == 0) checkpoint();
    const double y = cellCentre(0, row).y() + obstacles_.origin().y();
    if (inside && (y < polygon.box().min.y() || y > polygon.box().max.y())) continue;
    crossings.clear();
    for (std::size_t i = 0, j = points.size() - 1; i < points.size(); j = i++) {
      const Point2d &a = points[i], &b = points[j];
      if ((a.y() > y) == (b.y() > y)) continue;
      crossings.push_back((b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()) + a.x() - obstacles_.origin().x());
    }
    std::sort(crossings.begin(), crossings.end());
    std::size_t passed = 0;
    for (long column = 0; column < columns_; ++column) {
      const double x = cellCentre(column, row).x();
      while (passed < crossings.size() && crossings[passed] < x) ++passed;
      if ((passed % 2 == 1) == inside) states_[static_cast<std::size_t>(row * columns_ + column)] = State::kFilled;
    }
  }
}

bool FootprintIndex::isWithinAxleBounds(double x, double y) const {
  return x >= axle_bounds_.min.x() && x <= axle_bounds_.max.x() && y >= axle_bounds_.min.y() &&
         y <= axle_bounds_.max.y();
}

double FootprintIndex::freeRadius(const Frame& frame) const {
  if (!isWithinAxleBounds(frame.x, frame.y)) return -1.0;
  const double cx = frame.x + box_.centre * frame.cos, cy = frame.y + box_.centre * frame.sin;
  const long cell = cellAt(cx, cy);
  if (cell < 0) return outside_is_free_ ? 0.0 : -1.0;
  const auto at = static_cast<std::size_t>(cell);
  const double room = static_cast<double>(near_[at]) - cell_reach_ - reach_;
  if (room > 0.0) return states_[at] == State::kFree ? room : -1.0;
  if (!edgesAreClear(cell, frame, cx, cy)) return -1.0;
  // No edge meets the footprint, so one point of it tells whether it is inside an obstacle. The cell's state holds for
  // all of the cell unless an edge passes through it.
  if (static_cast<double>(near_[at]) > cell_reach_) return states_[at] == State::kFree ? 0.0 : -1.0;
  return isFilled(cell, Point2d(cx, cy)) ? -1.0 : 0.0;
}

/// Where the cell's centre is free, only an obstacle with an edge between that and the point can fill it.
bool FootprintIndex::isFilled(long cell, const Point2d& point) const {
  if (states_[static_cast<std::size_t>(cell)] == State::kFilled) return obstacles_.filledBy(point).has_value();
  std::optional<int> asked;
  for (const std::uint32_t group : groupsNear(cell)) {
    const int source = obstacles_.edges()[groups_[group].first].source;
    if (source == asked) continue;
    if (obstacles_.isFilledBy(source, point)) return true;
    asked = source;
  }
  return false;
}

bool FootprintIndex::edgesAreClear(long cell, const Frame& frame, double cx, double cy) const {
  const double l = box_.half_length + margin_, w = box_.half_width + margin_;
  for (const std::uint32_t i : groupsNear(cell)) {
    const EdgeGroup& group = groups_[i];
    const double dx = group.core.mx - cx, dy = group.core.my - cy;
    const double mu = dx * frame.cos + dy * frame.sin, mv = dy * frame.cos - dx * frame.sin;
    const double hu = group.core.hx * frame.cos + group.core.hy * frame.sin;
    const double hv = group.core.hy * frame.cos - group.core.hx * frame.sin;
    if (!boxMeets(mu, mv, hu, hv, l + group.radius, w + group.radius)) continue;
    // Near a corner of the grown box the distance may still be kept.
    if (!edgesAreClear(group, frame, cx, cy)) return false;
  }
  return true;
}

bool FootprintIndex::edgesAreClear(const EdgeGroup& group, const Frame& frame, double cx, double cy) const {
  for (std::uint32_t i = group.first; i < group.last; ++i) {
    if (isTooNear(exactDistance(edges_[i], frame, cx, cy), i)) return false;
  }
  return true;
}

bool FootprintIndex::meetsEdge(const FootprintBox& part, const Frame& frame) const {
  const long cell = cellAt(frame.x + box_.centre * frame.cos, frame.y + box_.centre * frame.sin);
  if (cell < 0) return false;
  const double x = frame.x + part.centre * frame.cos, y = frame.y + part.centre * frame.sin;
  const auto meets = [&](const HalfEdge& edge, double grown) {
    const double dx = edge.mx - x, dy = edge.my - y;
    return boxMeets(dx * frame.cos + dy * frame.sin, dy * frame.cos - dx * frame.sin,
                    edge.hx * frame.cos + edge.hy * frame.sin, edge.hy * frame.cos - edge.hx * frame.sin,
                    part.half_length + grown, part.half_width + grown);
  };
  const GroupList near = groupsNear(cell);
  return std::any_of(near.begin(), near.end(), [&](std::uint32_t number) {
    const EdgeGroup& group = groups_[number];
    if (!meets(group.core, group.radius + margin_)) return false;
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      // A box grown by so much has its corners within the margin.
      if (meets(edges_[i], marginTo(i) * M_SQRT1_2)) return true;
    }
    return false;
  });
}

double FootprintIndex::exactDistance(const HalfEdge& edge, const Frame& frame, double cx, double cy) const {
  const double l = box_.half_length, w = box_.half_width;
  const double dx = edge.mx - cx, dy = edge.my - cy;
  const double mu = dx * frame.cos + dy * frame.sin, mv = dy * frame.cos - dx * frame.sin;
  const double hu = edge.hx * frame.cos + edge.hy * frame.sin, hv = edge.hy * frame.cos - edge.hx * frame.sin;
  if (boxMeets(mu, mv, hu, hv, l, w)) return 0.0;
  double best = std::min(pointToBox(mu - hu, mv - hv, l, w), pointToBox(mu + hu, mv + hv, l, w));
  const double half_squared = std::max(hu * hu + hv * hv, 1e-18);
  for (int corner = 0; corner < 4; ++corner) {
    const double u = (corner & 1 ? l : -l) - mu, v = (corner & 2 ? w : -w) - mv;
    const double t = std::clamp((u * hu + v * hv) / half_squared, -1.0, 1.0);
    best = std::min(best, squared(u - t * hu) + squared(v - t * hv));
  }
  return std::sqrt(best);
}

double FootprintIndex::freeLength(const Pose2d& from, const ArcSegment& arc, double step) const {
  const double length = std::abs(arc.length), corner_speed = box_.cornerSpeed(arc.kappa);
  const double steps = std::ceil(length * corner_speed / step);
  const double step_length = arc.length / std::max(steps, 1.0);
  Frame frame(from);
  double room = 0.0, steps_of_stride = 1.0;
  Stride stride(arc.kappa, step_length);
  for (double done = 0.0; done < steps;) {
    const double skip = std::min(1.0 + std::floor(room / (corner_speed * std::abs(step_length))), steps - done);
    if (skip != steps_of_stride) stride = Stride(arc.kappa, skip * step_length), steps_of_stride = skip;
    frame.drive(stride);
    room = freeRadius(frame);
    if (room < 0.0) return done * std::abs(step_length);
    done += skip;
  }
  return length;
}

double FootprintIndex::exactRoom(const Frame& frame) const {
  const double bound = freeRadius(frame);
  if (bound != 0.0) return bound;
  const double cx = frame.x + box_.centre * frame.cos, cy = frame.y + box_.centre * frame.sin;
  const long cell = cellAt(cx, cy);
  double room = kBeyond;
  if (cell < 0) return 0.0;
  for (const std::uint32_t number : groupsNear(cell)) {
    const EdgeGroup& group = groups_[number];
    if (group.radius > 0.0 && exactDistance(group.core, frame, cx, cy) - group.radius - margin_ >= room) continue;
    for (std::uint32_t i = group.first; i < group.last; ++i) {
      room = std::min(room, exactDistance(edges_[i], frame, cx, cy) - marginTo(i));
    }
  }
  return room;
}

bool FootprintIndex::keepsMargin(const Pose2d& from, const ArcSegment& arc) const {
  const double length = std::abs(arc.length), corner_speed = box_.cornerSpeed(arc.kappa);
  Frame frame(from);
  double room = 0.0;
  for (double s = 0.0; s < length;) {
    const double step = std::min(std::max(room, kFineStep) / corner_speed, length - s);
    frame.drive(Stride(arc.kappa, std::copysign(step, arc.length)));
    room = exactRoom(frame);
    if (room < 0.0) return false;
    s += step;
  }
  return true;
}

Point2d FootprintIndex::snapped(const Point2d& point) const {
  if (columns_ == 0) return point;
  const Point2d corner = extent_.min - Point2d(reach_, reach_);
  return corner + cell_size_ * ((point - corner) / cell_size_).array().floor().matrix();
}

}  // namespace external_command
