// SPDX-License-Identifier: Apache-2.0
#include "simple_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>

#include "external_command/core/polygon.h"

namespace external_command {

namespace {

using EdgePair = std::pair<std::size_t, std::size_t>;
__extension__ using Wide = __int128;  ///< holds the products of differences of lattice coordinates exactly

constexpr double kTouching = 1e-6;  // [m]
constexpr int kLatticeBits = 30;    ///< the lattice is 2^-30 m fine, about what a double resolves in UTM coordinates
constexpr int kCellBits = 11;       ///< cells of 2^11 lattice lines are wider than kTouching

bool isOn(const Point2d& point, const Point2d& a, const Point2d& b) {
  return (point - nearestOnSegment(point, a, b)).squaredNorm() < kTouching * kTouching;
}

bool edgesMeet(const std::vector<Point2d>& points, std::size_t i, std::size_t j) {
  const std::size_t n = points.size();
  const Point2d &a = points[i], &b = points[(i + 1) % n], &c = points[j], &d = points[(j + 1) % n];
  if ((a.cwiseMin(b).array() > c.cwiseMax(d).array() + kTouching).any()) return false;
  if ((c.cwiseMin(d).array() > a.cwiseMax(b).array() + kTouching).any()) return false;
  if ((i + 1) % n == j) return isOn(a, c, d) || isOn(d, a, b);
  if ((j + 1) % n == i) return isOn(c, a, b) || isOn(b, c, d);
  if (isOn(a, c, d) || isOn(b, c, d) || isOn(c, a, b) || isOn(d, a, b)) return true;
  return cross(b - a, c - a) * cross(b - a, d - a) < 0.0 && cross(d - c, a - c) * cross(d - c, b - c) < 0.0;
}

/// A point of the lattice; ordered by x, then by y.
struct Node {
  std::int64_t x = 0;
  std::int64_t y = 0;

  bool operator<(const Node& other) const { return x != other.x ? x < other.x : y < other.y; }
  bool operator==(const Node& other) const { return x == other.x && y == other.y; }
};

/// Positive where `c` lies to the left of the line from `a` to `b`.
Wide sideOf(const Node& a, const Node& b, const Node& c) {
  return Wide(b.x - a.x) * Wide(c.y - a.y) - Wide(b.y - a.y) * Wide(c.x - a.x);
}

std::vector<Node> nodesOf(const std::vector<Point2d>& points) {
  std::vector<Node> nodes;
  nodes.reserve(points.size());
  for (const Point2d& point : points) {
    const Point2d scaled = (point - points[0]) * std::ldexp(1.0, kLatticeBits);
    nodes.push_back({std::llround(scaled.x()), std::llround(scaled.y())});
  }
  return nodes;
}

/// Edges whose first vertices touch.
std::optional<EdgePair> touchingVertices(const std::vector<Point2d>& points, const std::vector<Node>& nodes) {
  std::vector<std::pair<Node, std::size_t>> cells;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    cells.push_back({{nodes[i].x >> kCellBits, nodes[i].y >> kCellBits}, i});
  }
  std::sort(cells.begin(), cells.end());
  for (const auto& [cell, vertex] : cells) {
    for (std::int64_t column = cell.x; column <= cell.x + 1; ++column) {
      auto near = std::lower_bound(cells.begin(), cells.end(), std::pair(Node{column, cell.y - 1}, std::size_t{0}));
      for (; near != cells.end() && near->first.x == column && near->first.y <= cell.y + 1; ++near) {
        const bool touch = near->second != vertex && (points[vertex] - points[near->second]).norm() < kTouching;
        if (touch) return std::minmax({vertex, near->second});
      }
    }
  }
  return std::nullopt;
}

/// A line that sweeps over the edges and compares those that are neighbours on it (M. I. Shamos and D. Hoey, "Geometric
/// intersection problems", 1976). Their order on it is exact: decided on the lattice.
class EdgeSweep {
 public:
  /// @param nodes  no two alike.
  EdgeSweep(const std::vector<Point2d>& points, const std::vector<Node>& nodes)
      : points_(points), nodes_(nodes), open_(Below{this}), places_(nodes.size()) {}

  std::optional<EdgePair> find() {
    std::vector<std::size_t> order(nodes_.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [this](std::size_t i, std::size_t j) { return nodes_[i] < nodes_[j]; });
    for (const std::size_t vertex : order) {
      const std::size_t edges[] = {vertex, (vertex + nodes_.size() - 1) % nodes_.size()};
      for (const std::size_t edge : edges) {
        if (lowEnd(edge) == nodes_[vertex] && opens(edge)) return found_;
      }
      for (const std::size_t edge : edges) {
        if (highEnd(edge) == nodes_[vertex] && closes(edge)) return found_;
      }
    }
    return std::nullopt;
  }

 private:
  struct Below {
    const EdgeSweep* sweep;
    bool operator()(std::size_t i, std::size_t j) const { return sweep->isBelow(i, j); }
  };
  using Edges = std::set<std::size_t, Below>;

  const Node& lowEnd(std::size_t edge) const { return std::min(nodes_[edge], nodes_[(edge + 1) % nodes_.size()]); }
  const Node& highEnd(std::size_t edge) const { return std::max(nodes_[edge], nodes_[(edge + 1) % nodes_.size()]); }

  /// Of edges that the sweep line crosses both, and that do not cross each other.
  bool isBelow(std::size_t i, std::size_t j) const {
    if (i == j) return false;
    const Node &low = lowEnd(i), &high = highEnd(i), &other_low = lowEnd(j), &other_high = highEnd(j);
    if (low < other_low || low == other_low) {
      Wide side = sideOf(low, high, other_low);
      if (side == 0) side = sideOf(low, high, other_high);
      return side != 0 ? side > 0 : i < j;
    }
    Wide side = sideOf(other_low, other_high, low);
    if (side == 0) side = sideOf(other_low, other_high, high);
    return side != 0 ? side < 0 : i < j;
  }

  bool opens(std::size_t edge) {
    const auto place = places_[edge] = open_.insert(edge).first;
    return (place != open_.begin() && meet(*std::prev(place), edge)) ||
           (std::next(place) != open_.end() && meet(edge, *std::next(place)));
  }

  /// @return whether the edges that become neighbours then meet.
  bool closes(std::size_t edge) {
    const auto after = open_.erase(places_[edge]);
    return after != open_.begin() && after != open_.end() && meet(*std::prev(after), *after);
  }

  bool meet(std::size_t i, std::size_t j) {
    if (edgesMeet(points_, i, j)) found_ = std::minmax(i, j);
    return found_.has_value();
  }

  const std::vector<Point2d>& points_;
  const std::vector<Node>& nodes_;
  Edges open_;                           ///< that the sweep line crosses, from below
  std::vector<Edges::iterator> places_;  ///< of each open edge
  std::optional<EdgePair> found_;
};

}  // namespace

/// One sweep finds whatever crosses. What only touches can be a neighbour along one axis alone: beside a steep edge it
/// is none above or below. Hence two sweeps, and the vertices by themselves.
std::optional<EdgePair> meetingEdges(const std::vector<Point2d>& points) {
  std::vector<Node> nodes = nodesOf(points);
  if (const auto touching = touchingVertices(points, nodes)) return touching;
  if (const auto meeting = EdgeSweep(points, nodes).find()) return meeting;
  for (Node& node : nodes) std::swap(node.x, node.y);
  return EdgeSweep(points, nodes).find();
}

}  // namespace external_command
