// SPDX-License-Identifier: Apache-2.0
#include "lane_graph.h"

namespace external_command {

LaneGraph::LaneGraph(const HdMap& map) {
  const std::size_t count = map.lanes().size();
  lengths_.reserve(count);
  routable_.reserve(count);
  for (const Lane& lane : map.lanes()) {
    lengths_.push_back(lane.length());
    routable_.push_back(external_command::isRoutable(lane));
  }
  for (LaneIndex i = 0; i < count; ++i) {
    first_successor_.push_back(static_cast<std::uint32_t>(successors_.size()));
    first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    if (!routable_[i]) continue;
    const Lane& lane = map.lane(i);
    for (const LaneIndex next : lane.successors) {
      if (routable_[next]) successors_.push_back(next);
    }
    for (const LaneIndex other : lane.left_forward) addNeighbour(map, i, other, LaneChange::kLeft);
    for (const LaneIndex other : lane.right_forward) addNeighbour(map, i, other, LaneChange::kRight);
  }
  first_successor_.push_back(static_cast<std::uint32_t>(successors_.size()));
  first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
}

void LaneGraph::addNeighbour(const HdMap& map, LaneIndex a, LaneIndex b, LaneChange side) {
  if (!routable_[b]) return;
  const auto pair = pairOf(map, a, b, side);
  if (!pair) return;
  const auto first = static_cast<std::uint32_t>(parts_.size());
  for (const Interval& part : external_command::crossableParts(map, a, *pair)) parts_.push_back(part);
  const auto last = static_cast<std::uint32_t>(parts_.size());
  if (last > first) neighbours_.push_back({*pair, first, last});
}

const LaneGraph::Neighbour* LaneGraph::findNeighbour(LaneIndex a, LaneIndex b, LaneChange side) const {
  for (const Neighbour& neighbour : neighbours(a)) {
    if (neighbour.pair.b == b && neighbour.pair.side == side) return &neighbour;
  }
  return nullptr;
}

}  // namespace external_command
