// SPDX-License-Identifier: Apache-2.0
#include "lane_graph.h"

#include <algorithm>

namespace external_command {

LaneGraph::LaneGraph(const HdMap& map, const RouterParams& params) {
  const std::size_t count = map.lanes().size();
  lengths_.reserve(count);
  routable_.reserve(count);
  for (const Lane& lane : map.lanes()) {
    lengths_.push_back(lane.length());
    routable_.push_back(lane.isDrivable());
  }
  for (LaneIndex i = 0; i < count; ++i) {
    first_successor_.push_back(static_cast<std::uint32_t>(successors_.size()));
    first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    if (!routable_[i]) continue;
    const Lane& lane = map.lane(i);
    for (std::size_t k = 0; k < lane.successors.size(); ++k) {
      if (routable_[lane.successors[k]]) successors_.push_back({lane.successors[k], lane.entries[k]});
    }
    for (const LaneIndex other : lane.left_forward) {
      addNeighbour(map, i, other, LaneChange::kLeft, params.min_turning_radius);
    }
    for (const LaneIndex other : lane.right_forward) {
      addNeighbour(map, i, other, LaneChange::kRight, params.min_turning_radius);
    }
  }
  first_successor_.push_back(static_cast<std::uint32_t>(successors_.size()));
  first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
}

void LaneGraph::addNeighbour(const HdMap& map, LaneIndex a, LaneIndex b, LaneChange side, double min_turning_radius) {
  if (!routable_[b]) return;
  const auto pair = pairOf(map, a, b, side);
  if (!pair) return;
  const auto first = static_cast<std::uint32_t>(parts_.size());
  for (const Interval& part : external_command::crossableParts(map, a, *pair)) parts_.push_back(part);
  const auto last = static_cast<std::uint32_t>(parts_.size());
  if (last == first) return;
  const auto first_need = static_cast<std::uint32_t>(needs_.size());
  for (const ChangeNeed& need : external_command::changeNeeds(map, a, *pair, min_turning_radius)) {
    needs_.push_back(need);
  }
  neighbours_.push_back({*pair, first, last, first_need, static_cast<std::uint32_t>(needs_.size())});
}

double LaneGraph::changeNeed(const Neighbour& neighbour, double s) const {
  const Span<ChangeNeed> needs = changeNeeds(neighbour);
  const auto after = [](double value, const ChangeNeed& need) { return value < static_cast<double>(need.s); };
  auto need = std::max(needs.begin() + 1, std::upper_bound(needs.begin(), needs.end(), s, after)) - 1;
  double length = static_cast<double>(need->length);
  // Each piece that the change reaches has a say, and may make it reach further.
  for (++need; need != needs.end() && static_cast<double>(need->s) < s + length; ++need) {
    length = std::max(length, static_cast<double>(need->length));
  }
  return length;
}

const LaneGraph::Neighbour* LaneGraph::findNeighbour(LaneIndex a, LaneIndex b, LaneChange side) const {
  for (const Neighbour& neighbour : neighbours(a)) {
    if (neighbour.pair.b == b && neighbour.pair.side == side) return &neighbour;
  }
  return nullptr;
}

}  // namespace external_command
