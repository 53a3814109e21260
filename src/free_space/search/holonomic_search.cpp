// SPDX-License-Identifier: Apache-2.0
#include "holonomic_search.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kTurnPrice = 1.0;    ///< of a radian on the spot, in turning radii: what driving a full-lock arc costs
constexpr double kSidePrice = 4.0;    ///< of a metre sideways [m]
constexpr double kTightRoom = 0.2;    ///< with so much around it, to shift the vehicle costs twice as much [m]
constexpr double kLeastRoom = 0.004;  ///< less does not cost more [m]
constexpr double kWeight = 3.0;       ///< of the estimate: the first way matters, not the cheapest
constexpr double kCheckStep = 0.06;   ///< most that a corner moves between two checks [m]

/// Around a pose to avoid.
constexpr double kAvoidedFactor = 10.0;
constexpr double kAvoidedRadius = 0.3;  ///< [m]
constexpr double kAvoidedAngle = 0.2;   ///< [rad]

}  // namespace

const std::vector<HolonomicSearch::Level>& HolonomicSearch::levels() {
  static const std::vector<Level> levels{{0.1, 2.0 * M_PI / 64, 0.2, 100'000}, {0.05, 2.0 * M_PI / 128, 0.1, 200'000}};
  return levels;
}

HolonomicSearch::HolonomicSearch(const Scene& scene, const Pose2d& from, const Pose2d& to, const DistanceMap& map)
    : scene_(scene), from_(from), to_(to), map_(map) {}

std::vector<Pose2d> HolonomicSearch::way(const std::function<bool()>& stop) {
  std::vector<Pose2d> way;
  for (const Level& level : levels()) {
    level_ = level;
    if (search(stop, &way) || stop()) break;
  }
  return way;
}

bool HolonomicSearch::search(const std::function<bool()>& stop, std::vector<Pose2d>* way) {
  nodes_.clear();
  queue_.clear();
  by_cell_.clear();
  add(CellNodes::kNone, from_, 0.0);
  const std::uint64_t last = cellAt(to_);
  while (!queue_.empty() && nodes_.size() < level_.max_nodes && !stop()) {
    const int node = takeBest();
    if (at(node).closed) continue;
    at(node).closed = true;
    if (cellAt(at(node).pose) == last) {
      *way = wayTo(node);
      return true;
    }
    grow(node);
  }
  return false;
}

int HolonomicSearch::takeBest() {
  std::pop_heap(queue_.begin(), queue_.end());
  const int node = queue_.back().node;
  queue_.pop_back();
  return node;
}

void HolonomicSearch::grow(int node) {
  const Pose2d pose = at(node).pose;
  const FootprintBox& box = scene_.index.box();
  const double reach = std::hypot(std::abs(box.centre) + box.half_length, box.half_width);
  const Point2d along = unitVector(pose.heading), left(-along.y(), along.x());
  for (const double side : {-1.0, 1.0}) {
    for (const int steer : {-1, 0, 1}) drive(node, {side * level_.stride, steer / scene_.radius});
    const double angle = side * level_.heading_cell;
    shift(node, {pose.x, pose.y, normalizeAngle(pose.heading + angle)}, std::abs(angle) * reach,
          kTurnPrice * scene_.radius * std::abs(angle));
    const Point2d beside = pose.position() + side * level_.cell * left;
    shift(node, {beside.x(), beside.y(), pose.heading}, level_.cell, kSidePrice * level_.cell);
  }
}

void HolonomicSearch::drive(int node, const ArcSegment& arc) {
  const Pose2d from = at(node).pose, to = advance(from, arc);
  const double g = at(node).g + std::abs(arc.length);
  if (!isBetter(to, g) || scene_.index.freeLength(from, arc, kCheckStep) < std::abs(arc.length)) return;
  add(node, to, g);
}

/// @param length  of the way of the corner that moves most [m]
void HolonomicSearch::shift(int node, const Pose2d& to, double length, double price) {
  const Pose2d from = at(node).pose;
  if (!isBetter(to, at(node).g + price)) return;
  const double turn = angleBetween(from.heading, to.heading), steps = std::ceil(length / kCheckStep);
  for (double i = 1.0; i <= steps; ++i) {
    const Point2d position = from.position() + i / steps * (to.position() - from.position());
    if (!scene_.index.isFree({position.x(), position.y(), from.heading + i / steps * turn})) return;
  }
  add(node, to, at(node).g + price * priceFactor(from, to));
}

double HolonomicSearch::priceFactor(const Pose2d& from, const Pose2d& to) const {
  const double room = std::min(scene_.index.exactRoom(Frame(from)), scene_.index.exactRoom(Frame(to)));
  const double factor = 1.0 + kTightRoom / std::max(room, kLeastRoom);
  const auto is_avoided = [&](const Pose2d& pose) {
    return (pose.position() - to.position()).norm() < kAvoidedRadius &&
           std::abs(angleBetween(pose.heading, to.heading)) < kAvoidedAngle;
  };
  return std::any_of(avoided_.begin(), avoided_.end(), is_avoided) ? kAvoidedFactor * factor : factor;
}

bool HolonomicSearch::isBetter(const Pose2d& pose, double g) const {
  const int other = by_cell_.at(cellAt(pose));
  return other == CellNodes::kNone || g + 1e-6 < at(other).g;
}

void HolonomicSearch::add(int parent, const Pose2d& pose, double g) {
  const double left = costLeft(pose);
  if (!std::isfinite(left) || !isBetter(pose, g)) return;
  const std::uint64_t cell = cellAt(pose);
  const int other = by_cell_.at(cell), node = static_cast<int>(nodes_.size());
  if (other != CellNodes::kNone) at(other).closed = true;
  by_cell_.set(cell, node);
  nodes_.push_back({pose, g, parent});
  queue_.push_back({g + kWeight * left, node});
  std::push_heap(queue_.begin(), queue_.end());
}

/// Not a lower bound: one arc can do both. Where it is tight the vehicle seldom turns on the way.
double HolonomicSearch::costLeft(const Pose2d& pose) const {
  return map_.at(pose.x, pose.y) + scene_.radius * std::abs(angleBetween(pose.heading, to_.heading));
}

std::vector<Pose2d> HolonomicSearch::wayTo(int node) const {
  std::vector<Pose2d> way{to_};
  for (int i = node; i != CellNodes::kNone; i = at(i).parent) way.push_back(at(i).pose);
  return {way.rbegin(), way.rend()};
}

}  // namespace external_command
