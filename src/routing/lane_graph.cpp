// SPDX-License-Identifier: Apache-2.0
#include "lane_graph.h"

#include <algorithm>
#include <utility>

#include "external_command/core/in_parallel.h"

namespace external_command {

namespace {

constexpr std::size_t kLanesPerThread = 10000;  // fewer are not worth a thread

template <class T>
std::uint32_t sizeOf(const std::vector<T>& array) {
  return static_cast<std::uint32_t>(array.size());
}

template <class T>
void addAll(const std::vector<T>& more, std::vector<T>* array) {
  array->insert(array->end(), more.begin(), more.end());
}

}  // namespace

LaneGraph::LaneGraph(const HdMap& map, const RouterParams& params) {
  const std::size_t count = map.lanes().size();
  lengths_.reserve(count);
  routable_.reserve(count);
  for (const Lane& lane : map.lanes()) {
    lengths_.push_back(lane.length());
    routable_.push_back(lane.isDrivable());
  }
  std::vector<Links> parts(parallelParts(count / kLanesPerThread));
  inParallel(parts.size(), [&](std::size_t part) {
    for (std::size_t lane = part * count / parts.size(); lane < (part + 1) * count / parts.size(); ++lane) {
      addLane(map, static_cast<LaneIndex>(lane), params.min_turning_radius, &parts[part]);
    }
  });
  links_ = std::move(parts.front());
  for (auto part = parts.begin() + 1; part != parts.end(); ++part) links_.append(*part);
  links_.first_successor.push_back(sizeOf(links_.successors));
  links_.first_neighbour.push_back(sizeOf(links_.neighbours));
}

void LaneGraph::addLane(const HdMap& map, LaneIndex index, double min_turning_radius, Links* links) const {
  links->first_successor.push_back(sizeOf(links->successors));
  links->first_neighbour.push_back(sizeOf(links->neighbours));
  if (!routable_[index]) return;
  const Lane& lane = map.lane(index);
  for (std::size_t k = 0; k < lane.successors.size(); ++k) {
    if (routable_[lane.successors[k]]) links->successors.push_back({lane.successors[k], lane.entries[k]});
  }
  for (const auto& [others, side] :
       {std::pair(&lane.left_forward, LaneChange::kLeft), std::pair(&lane.right_forward, LaneChange::kRight)}) {
    for (const LaneIndex other : *others) {
      if (routable_[other]) addNeighbour(map, index, other, side, min_turning_radius, links);
    }
  }
}

void LaneGraph::addNeighbour(const HdMap& map, LaneIndex a, LaneIndex b, LaneChange side, double min_turning_radius,
                             Links* links) {
  const auto pair = pairOf(map, a, b, side);
  if (!pair) return;
  const std::vector<Interval> parts = external_command::crossableParts(map, a, *pair);
  if (parts.empty()) return;
  const std::vector<ChangeNeed> needs = external_command::changeNeeds(map, a, *pair, min_turning_radius);
  const auto first_part = sizeOf(links->parts);
  const auto first_need = sizeOf(links->needs);
  addAll(parts, &links->parts);
  addAll(needs, &links->needs);
  links->neighbours.push_back({*pair, first_part, sizeOf(links->parts), first_need, sizeOf(links->needs)});
}

void LaneGraph::Links::append(const Links& next) {
  for (const std::uint32_t first : next.first_successor) first_successor.push_back(first + sizeOf(successors));
  for (const std::uint32_t first : next.first_neighbour) first_neighbour.push_back(first + sizeOf(neighbours));
  for (Neighbour neighbour : next.neighbours) {
    neighbour.first_part += sizeOf(parts);
    neighbour.last_part += sizeOf(parts);
    neighbour.first_need += sizeOf(needs);
    neighbour.last_need += sizeOf(needs);
    neighbours.push_back(neighbour);
  }
  addAll(next.successors, &successors);
  addAll(next.parts, &parts);
  addAll(next.needs, &needs);
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
