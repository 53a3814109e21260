// SPDX-License-Identifier: Apache-2.0
#include "search_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace external_command {

namespace {

constexpr double kCheckStep = 0.06;     ///< most that a corner moves between two checks of the search [m]
constexpr double kShortestStep = 0.15;  ///< of a stride: shorter ways to an obstacle are no step
constexpr std::uint64_t kNoKey = ~0ULL;
constexpr std::size_t kFirstTable = 4096;  ///< a power of two, like all sizes of the table

}  // namespace

SearchTree::SearchTree(const Scene& scene, const Pose2d& root, int root_gear, const DistanceMap& map)
    : scene_(scene), root_(root), root_gear_(root_gear), map_(map) {}

void SearchTree::restart(const SearchLevel& level) {
  level_ = level;
  nodes_.clear();
  queue_.clear();
  keys_.assign(kFirstTable, kNoKey);
  values_.assign(kFirstTable, -1);
  advanced_ = 0;
  Node root{root_, {}, 0.0, map_.at(root_.x, root_.y), -1, root_gear_};
  root.arrival = Arrival::kFree;
  nodes_.push_back(root);
  push(0);
}

void SearchTree::push(int node) {
  queue_.push_back({at(node).g + level_.weight * at(node).h, node});
  std::push_heap(queue_.begin(), queue_.end());
}

std::uint64_t SearchTree::keyOf(const Pose2d& pose, int gear) const {
  const auto cell = [&](double value) {
    return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(value / level_.cell + level_.shift)) + (1 << 20));
  };
  const double turns = 2.0 * M_PI / level_.heading_cell;
  const auto heading = static_cast<std::uint64_t>(
      std::llround((pose.heading / (2.0 * M_PI) + 1.0) * turns + level_.shift) % std::llround(turns));
  return (cell(pose.x) & 0x1FFFFF) << 40 | (cell(pose.y) & 0x1FFFFF) << 19 | heading << 1 | (gear > 0 ? 1U : 0U);
}

int* SearchTree::slotOf(std::uint64_t key) {
  const std::size_t mask = keys_.size() - 1;
  std::size_t i = (key * 0x9E3779B97F4A7C15ULL >> 32) & mask;
  while (keys_[i] != kNoKey && keys_[i] != key) i = (i + 1) & mask;
  keys_[i] = key;
  return &values_[i];
}

void SearchTree::growTable() {
  if (nodes_.size() * 2 < keys_.size()) return;
  const std::vector<std::uint64_t> keys = std::move(keys_);
  const std::vector<int> values = std::move(values_);
  keys_.assign(keys.size() * 2, kNoKey);
  values_.assign(keys.size() * 2, -1);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    if (keys[i] != kNoKey) *slotOf(keys[i]) = values[i];
  }
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
      if (!queue_.empty() && at(index).g + level_.weight * at(index).h > queue_.front().f) {
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
    if (!isFree(scene_.index, at(index).pose, word, kCheckStep)) continue;
    if (!confirm(index) || !other->confirm(other_index)) return;
    if (!keepsMargin(scene_.index, at(index).pose, word)) continue;
    *max_cost = fixed_cost + word.cost;
    *found = Connection{index, other_index, word};
    return;
  }
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
  const Pose2d pose = at(index).pose;
  const ArcSegment arrival = at(index).arc;
  for (const int steer : {-1, 0, 1}) {
    for (const int gear : {1, -1}) {
      const ArcSegment arc{gear * level_.stride, steer / scene_.radius};
      const bool is_way_back = arrival.length * arc.length < 0.0 && arrival.kappa == arc.kappa;
      if (is_way_back) continue;
      const double free = scene_.index.freeLength(pose, arc, kCheckStep);
      if (free >= kShortestStep * level_.stride) addChild(index, {gear * free, arc.kappa}, max_cost);
    }
  }
}

void SearchTree::addChild(int parent_index, const ArcSegment& arc, double max_cost) {
  const Node& parent = at(parent_index);
  const Pose2d pose = advance(parent.pose, arc);
  const int gear = gearOf(arc);
  const double driving = scene_.cost.ofArc(arc.length);
  const double g = parent.g + driving + (parent.gear == -gear ? scene_.cost.gear_change_cost : 0.0);
  const double h = std::max(map_.at(pose.x, pose.y), parent.h - driving);
  if (!(g + h < max_cost)) return;
  growTable();
  int* slot = slotOf(keyOf(pose, gear));
  if (*slot >= 0) {
    if (at(*slot).g <= g + 1e-6) return;
    at(*slot).closed = true;
  }
  *slot = static_cast<int>(nodes_.size());
  nodes_.push_back({pose, arc, g, h, parent_index, gear});
  push(*slot);
}

Arcs SearchTree::arcsTo(int node) const {
  Arcs arcs;
  for (int i = node; at(i).parent >= 0; i = at(i).parent) arcs.push_back(at(i).arc);
  return {arcs.rbegin(), arcs.rend()};
}

}  // namespace external_command
