// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <map>

#include "footprint_index.h"

namespace external_command {

void FootprintIndex::easeMargin(std::size_t number, const Pose2d& pose) {
  const Frame frame(pose);
  const Point2d centre(frame.x + box_.centre * frame.cos, frame.y + box_.centre * frame.sin);
  std::map<int, double> distances;  // of those that are too near
  for (const ObstacleEdge& edge : obstacles_.edges()) {
    if ((nearestOnSegment(centre, edge.begin, edge.end) - centre).norm() > reach_) continue;
    const double distance = distanceTo(edge, frame);
    if (distance <= 0.0) return;
    if (distance >= margin_) continue;
    const auto known = distances.emplace(edge.source, distance).first;
    known->second = std::min(known->second, distance);
  }
  if (distances.empty() || obstacles_.filledBy(centre)) return;
  EasedMargin nearest{number, margin_, 0, margin_, 0.0};
  for (const auto& [source, distance] : distances) {
    const EasedMargin eased{number, distance, source, 0.5 * distance, box_.circumradius() + 2.0 * box_.half_length};
    const std::size_t count = obstacles_.edges().size();
    for (std::size_t edge = 0; edge < count; ++edge) {
      if (obstacles_.edges()[edge].source == source) easeEdge(edge, centre, eased);
    }
    if (distance < nearest.distance) nearest = eased;
  }
  eased_.push_back(nearest);
}

/// The part of the edge that lies around `centre` gets the smaller margin; what is left of it stays as it was.
void FootprintIndex::easeEdge(std::size_t i, const Point2d& centre, const EasedMargin& eased) {
  const ObstacleEdge edge = obstacles_.edges()[i];
  const Point2d along = edge.end - edge.begin, seen = edge.begin - centre;
  const double a = along.squaredNorm(), b = along.dot(seen), c = seen.squaredNorm() - eased.within * eased.within;
  if (a <= 0.0 || b * b <= a * c) return;
  const double root = std::sqrt(b * b - a * c);
  const double from = std::max((-b - root) / a, 0.0), to = std::min((-b + root) / a, 1.0);
  if (from >= to) return;
  margins_.resize(obstacles_.edges().size(), margin_);
  obstacles_.cutEdge(i, from, to);
  margins_.resize(obstacles_.edges().size(), margins_[i]);
  margins_[i] = std::min(margins_[i], eased.margin);
}

}  // namespace external_command
