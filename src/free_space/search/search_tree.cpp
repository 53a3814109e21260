// SPDX-License-Identifier: Apache-2.0
#include "search_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace external_command {

namespace {

constexpr double kCheckStep = 0.06;     ///< most that a corner moves between two checks of the search [m]
constexpr double kShortestStep = 0.15;  ///< of a stride: shorter ways to an obstacle are no step
constexpr double kRootRange = 3.0;      ///< how far the arcs at a root are followed, in turning radii

}  // namespace

Reach::Reach(const Scene& scene, const Pose2d& from, double range) : range_(static_cast<float>(range)) {
  for (const int steer : {-1, 0, 1}) {
    for (const int gear : {1, -1}) {
      const double free = scene.index.freeLength(from, {gear * range, steer / scene.radius}, kCheckStep);
      free_[index(steer, gear)] = static_cast<float>(free);
    }
  }
}

bool Reach::allows(const ArcSegment& arc) const {
  const int steer = arc.kappa > 0.0 ? 1 : arc.kappa < 0.0 ? -1 : 0;
  const float free = free_[index(steer, gearOf(arc))];
  return free >= range_ || std::abs(arc.length) <= static_cast<double>(free) + kCheckStep;
}

SearchTree::SearchTree(const Scene& scene, const Pose2d& root, int root_gear, const DistanceMap& map)
    : scene_(scene),
      root_(root),
      root_gear_(root_gear),
      root_reach_(scene, root, kRootRange * scene.radius),
      map_(map) {}

void SearchTree::restart(const SearchLevel& level) {
  level_ = level;
  nodes_.clear();
  queue_.clear();
  by_cell_.clear();
  advanced_ = 0;
  Node root{root_, {}, 0.0, 0.0, map_.at(root_.x, root_.y), -1, root_gear_};
  root.arrival = Arrival::kFree;
  nodes_.push_back(root);
  push(0);
}

void SearchTree::push(int node) {
  queue_.push_back({at(node).rank + level_.weight * at(node).h, node});
  std::push_heap(queue_.begin(), queue_.end());
}

std::uint64_t SearchTree::keyOf(const Pose2d& pose, int gear) const {
  return cellOf(pose, level_.cell, level_.heading_cell, level_.shift) | (gear > 0 ? 1U : 0U);
}

std::optional<Connection> SearchTree::step(SearchTree* other, double* max_cost) {
  std::optional<Connection> found;
  while (!queue_.empty()) {
    std::pop_heap(queue_.begin(), queue_.end());
    const int index = queue_.back().node;
    queue_.pop_back();
    if (at(index).parent >= 0 && at(at(index).parent).arrival == Arrival::kBlocked) {
      at(index).arrival = Arrival::kBlocked;
    }
    if (at(index).closed || at(index).arrival == Arrival::kBlocked || at(index).g + at(index).h >= *max_cost) continue;
    if (!at(index).evaluated) {
      joinRoot(index, other, max_cost, &found);
      // Now that its heuristic is known better, another node may be the best.
      if (!queue_.empty() && at(index).rank + level_.weight * at(index).h > queue_.front().f) {
        push(index);
        return found;
      }
    }
    at(index).closed = true;
    if (other->advanced_ != 0) joinAdvanced(index, other, max_cost, &found);
    if (at(index).arrival != Arrival::kBlocked) grow(index, *max_cost);
    return found;
  }
  return found;
}

/// Words to the other root: the cheapest gives the heuristic, the cheapest free one a path.
void SearchTree::joinRoot(int index, SearchTree* other, double* max_cost, std::optional<Connection>* found) {
  Node& node = at(index);
  node.evaluated = true;
  node.reach = Reach(scene_, node.pose, level_.stride);
  WordSet words;
  WordQuery query;
  query.radius = scene_.radius;
  query.cost = scene_.cost;
  query.junctions = {node.gear, -other->root_gear_};
  reedsSheppWords(node.pose, other->root_, query, &words);
  double cheapest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < words.size(); ++i) cheapest = std::min(cheapest, words[i].cost);
  node.h = std::max(node.h, cheapest);
  if (node.h < at(advanced_).h) advanced_ = index;
  tryWords(index, other, 0, &words, max_cost, found);
}

void SearchTree::joinAdvanced(int index, SearchTree* other, double* max_cost, std::optional<Connection>* found) {
  const Node &node = at(index), &end = other->at(other->advanced_);
  WordSet words;
  WordQuery query;
  query.radius = scene_.radius;
  query.cost = scene_.cost;
  query.junctions = {node.gear, -end.gear};
  query.max_cost = *max_cost - node.g - end.g;
  reedsSheppWords(node.pose, end.pose, query, &words);
  tryWords(index, other, other->advanced_, &words, max_cost, found);
}

void SearchTree::tryWords(int index, SearchTree* other, int other_index, WordSet* words, double* max_cost,
                          std::optional<Connection>* found) {
  const double fixed_cost = at(index).g + other->at(other_index).g;
  while (words->size() > 0) {
    const SteeringWord word = words->takeCheapest();
    if (fixed_cost + word.cost >= *max_cost) return;
    if (!mayJoin(index, *other, other_index, word)) continue;
    if (!isFree(scene_.index, at(index).pose, word, kCheckStep)) continue;
    if (!confirm(index) || !other->confirm(other_index)) return;
    if (!keepsMargin(scene_.index, at(index).pose, word)) continue;
    *max_cost = fixed_cost + word.cost;
    *found = Connection{index, other_index, word};
    return;
  }
}

/// A look at what is already known about the word's first and last arc.
bool SearchTree::mayJoin(int index, const SearchTree& other, int other_index, const SteeringWord& word) const {
  if (word.size == 0) return true;
  const ArcSegment &first = word.arcs[0], &last = word.arcs[static_cast<std::size_t>(word.size) - 1];
  const Reach& arrival = other_index == 0 ? other.root_reach_ : other.at(other_index).reach;
  return at(index).reach.allows(first) && arrival.allows({-last.length, last.kappa});
}

/// Checks the way from the root finely. A node that fails, and later its children, are out.
bool SearchTree::confirm(int index) {
  for (int i = index; at(i).parent >= 0; i = at(i).parent) {
    Node& node = at(i);
    if (node.arrival == Arrival::kUnknown) {
      const bool free = scene_.index.keepsMargin(at(node.parent).pose, node.arc);
      node.arrival = free ? Arrival::kFree : Arrival::kBlocked;
    }
    if (node.arrival == Arrival::kBlocked) {
      at(index).arrival = Arrival::kBlocked;
      return false;
    }
  }
  return true;
}

void SearchTree::grow(int index, double max_cost) {
  const ArcSegment arrival = at(index).arc;
  const Reach reach = at(index).reach;
  for (const int steer : {-1, 0, 1}) {
    for (const int gear : {1, -1}) {
      const double free = std::min(reach.along(steer, gear), level_.stride);
      const ArcSegment arc{gear * free, steer / scene_.radius};
      const bool is_way_back = arrival.length * arc.length < 0.0 && arrival.kappa == arc.kappa;
      if (!is_way_back && free >= kShortestStep * level_.stride) addChild(index, arc, max_cost);
    }
  }
}

void SearchTree::addChild(int parent_index, const ArcSegment& arc, double max_cost) {
  const Node& parent = at(parent_index);
  const Pose2d pose = advance(parent.pose, arc);
  const int gear = gearOf(arc);
  const double driving = scene_.cost.ofArc(arc.length);
  const double changing = parent.gear == -gear ? scene_.cost.gear_change_cost : 0.0;
  const double g = parent.g + driving + changing;
  const double rank = parent.rank + driving + level_.gear_weight * changing;
  const double h = std::max(map_.at(pose.x, pose.y), parent.h - driving);
  if (!(g + h < max_cost)) return;
  const std::uint64_t cell = keyOf(pose, gear);
  const int other = by_cell_.at(cell), node = static_cast<int>(nodes_.size());
  if (other != CellNodes::kNone) {
    if (at(other).rank <= rank + 1e-6) return;
    at(other).closed = true;
  }
  by_cell_.set(cell, node);
  nodes_.push_back({pose, arc, g, rank, h, parent_index, gear});
  push(node);
}

Arcs SearchTree::arcsTo(int node) const {
  Arcs arcs;
  for (int i = node; at(i).parent >= 0; i = at(i).parent) arcs.push_back(at(i).arc);
  return {arcs.rbegin(), arcs.rend()};
}

}  // namespace external_command
