// SPDX-License-Identifier: Apache-2.0
#include "grid.h"

namespace external_command {

CoverageGrid::CoverageGrid(const BoundingBox& box, double cell)
    : corner_(box.min - Point2d(cell, cell)),
      cell_(cell),
      columns_(static_cast<int>((box.max.x() - box.min.x()) / cell) + 3),
      rows_(static_cast<int>((box.max.y() - box.min.y()) / cell) + 3),
      cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0) {}

void CoverageGrid::addEdges(const shapes::Ring& ring, std::vector<RowEdge>* edges) const {
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const Point2d a = (ring[i - 1] - corner_) / cell_ - Point2d(0.5, 0.5);
    const Point2d b = (ring[i] - corner_) / cell_ - Point2d(0.5, 0.5);
    const int first = std::max(0, static_cast<int>(std::ceil(std::min(a.y(), b.y()))));
    const int last = std::min(rows_ - 1, static_cast<int>(std::ceil(std::max(a.y(), b.y()))) - 1);
    if (first <= last) edges->push_back({first, last, a, b - a});
  }
}

/// Row by row: an edge is looked at in the rows of centres that it crosses, and forgotten.
void CoverageGrid::set(const shapes::Shapes& within, std::uint8_t flag) {
  std::vector<RowEdge> edges, open;
  for (const shapes::Shape& shape : within) {
    addEdges(shape.outer(), &edges);
    for (const auto& hole : shape.inners()) addEdges(hole, &edges);
  }
  std::sort(edges.begin(), edges.end(), [](const RowEdge& a, const RowEdge& b) { return a.first > b.first; });
  std::vector<double> xs;
  for (int row = 0; row < rows_; ++row) {
    for (; !edges.empty() && edges.back().first == row; edges.pop_back()) open.push_back(edges.back());
    open.erase(std::remove_if(open.begin(), open.end(), [row](const RowEdge& edge) { return edge.last < row; }),
               open.end());
    xs.clear();
    for (const RowEdge& edge : open) {
      xs.push_back(edge.from.x() + (row - edge.from.y()) * edge.along.x() / edge.along.y());
    }
    std::sort(xs.begin(), xs.end());
    for (std::size_t i = 0; i + 1 < xs.size(); i += 2) {
      const int begin = std::max(0, static_cast<int>(std::ceil(xs[i])));
      const int end = std::min(columns_ - 1, static_cast<int>(std::floor(xs[i + 1])));
      for (int column = begin; column <= end; ++column) cells_[index(column, row)] |= flag;
    }
  }
}

void CoverageGrid::clear(std::uint8_t flag) {
  for (std::uint8_t& cell : cells_) cell &= static_cast<std::uint8_t>(~flag);
}

double CoverageGrid::sweep(const Curve& curve, double width) {
  std::size_t added = 0;
  for (const auto& strip : stripsOf(curve, width)) {
    visitRuns(*this, strip, [&](std::uint8_t* first, std::uint8_t* last) {
      for (; first != last; ++first) {
        added += (*first & (kGoal | kSwept)) == kGoal;
        *first |= kSwept;
      }
    });
  }
  return static_cast<double>(added) * cellArea();
}

double CoverageGrid::gain(const std::vector<Curve>& curves, double width, double own_share) {
  std::size_t added = 0, own = 0;
  const auto mask = static_cast<std::uint8_t>(kGoal | kSwept | kMarked | kInner);
  std::vector<std::array<Point2d, 4>> strips;
  for (const Curve& curve : curves) {
    for (const auto& strip : stripsOf(curve, width)) strips.push_back(strip);
  }
  for (const auto& strip : strips) {
    visitRuns(*this, strip, [&](std::uint8_t* first, std::uint8_t* last) {
      for (; first != last; ++first) {
        if ((*first & mask) != kGoal) continue;
        ++((*first & kOwn) != 0 ? own : added);
        *first |= kMarked;
      }
    });
  }
  for (const auto& strip : strips) {
    visitRuns(*this, strip, [](std::uint8_t* first, std::uint8_t* last) {
      for (; first != last; ++first) *first &= static_cast<std::uint8_t>(~kMarked);
    });
  }
  return (static_cast<double>(added) + own_share * static_cast<double>(own)) * cellArea();
}

double CoverageGrid::area(std::uint8_t with, std::uint8_t without) const {
  std::size_t count = 0;
  const auto mask = static_cast<std::uint8_t>(with | without);
  for (const std::uint8_t cell : cells_) count += (cell & mask) == with;
  return static_cast<double>(count) * cellArea();
}

}  // namespace external_command
