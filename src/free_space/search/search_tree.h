// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "distance_map.h"
#include "free_space/manoeuvre.h"
#include "pose_cells.h"

namespace external_command {

/// How finely a tree searches.
struct SearchLevel {
  double cell;          ///< side of a cell [m]
  double heading_cell;  ///< [rad]
  double stride;        ///< length of a step [m]
  int max_nodes;        ///< then the level is given up
  double gear_weight;   ///< of gear changes in the order of the search: low values reach far places sooner
  double weight = 1.5;  ///< of the heuristic: finds a path sooner, at some cost that the improvement wins back
  double shift = 0.0;   ///< of the cells' borders, part of a cell
};

/// A curve that joins two trees.
struct Connection {
  int node = 0;        ///< of the tree that made it
  int other_node = 0;  ///< of the other tree
  SteeringWord word;   ///< from `node` to `other_node`
};

/// How far the six arcs (full lock either way or straight, in either gear) can be driven from a pose.
class Reach {
 public:
  Reach() = default;

  /// Looks no farther than `range` [m].
  Reach(const Scene& scene, const Pose2d& from, double range);

  double along(int steer, int gear) const { return static_cast<double>(free_[index(steer, gear)]); }

  /// False only for an arc that is known to meet an obstacle. Its curvature must be that of full lock, or 0.
  bool allows(const ArcSegment& arc) const;

 private:
  static std::size_t index(int steer, int gear) {
    return static_cast<std::size_t>(2 * (steer + 1) + (gear > 0 ? 1 : 0));
  }

  std::array<float, 6> free_{};
  float range_ = 0.0F;
};

/// Hybrid A* (D. Dolgov et al., "Path planning for autonomous vehicles in unknown semi-structured environments", 2010)
/// from one pose toward another: nodes are exact poses, one per cell of position, heading and gear, joined by arcs of
/// full lock or straight. Every node taken from the queue is also joined to the target by Reeds-Shepp words, whose
/// cost without obstacles is its heuristic. A step that runs into an obstacle ends at the last free pose: in a tight
/// place those are the poses that matter.
class SearchTree {
 public:
  /// @param root_gear  in which the vehicle arrives at the root, 0 if it stands there.
  /// @param map        distances to the other tree's root.
  SearchTree(const Scene& scene, const Pose2d& root, int root_gear, const DistanceMap& map);

  /// Forgets all nodes and begins anew.
  void restart(const SearchLevel& level);

  /// How many nodes are left to grow.
  std::size_t waiting() const { return queue_.size(); }

  /// Nothing left to grow.
  bool isEmpty() const { return queue_.empty(); }

  /// Too many nodes for the level, or none left to grow.
  bool isExhausted() const { return isEmpty() || static_cast<int>(nodes_.size()) >= level_.max_nodes; }

  /// Takes the best node, joins it to the other tree's root and to its most advanced node, and grows it.
  /// @param max_cost  of a whole path. Dearer ones are of no interest.
  /// @return the cheapest path found in this step, free of collisions along all of it.
  std::optional<Connection> step(SearchTree* other, double* max_cost);

  /// Arcs from the root to the node.
  Arcs arcsTo(int node) const;

 private:
  /// What is known about the arc that leads to a node, beyond the coarse check it passed.
  enum class Arrival : std::int8_t { kUnknown, kFree, kBlocked };

  struct Node {
    Pose2d pose;
    ArcSegment arc;  ///< from the parent
    double g;        ///< cost from the root
    double rank;     ///< the same with weighted gear changes
    double h;        ///< estimate of the cost that is left
    int parent;
    int gear;
    bool evaluated = false;  ///< h is that of the words, and `reach` is known
    bool closed = false;
    Arrival arrival = Arrival::kUnknown;
    Reach reach{};
  };

  struct Entry {
    double f;
    int node;
    bool operator<(const Entry& other) const { return f > other.f; }
  };

  void push(int node);
  void joinRoot(int node, SearchTree* other, double* max_cost, std::optional<Connection>* found);
  void joinAdvanced(int node, SearchTree* other, double* max_cost, std::optional<Connection>* found);
  void tryWords(int node, SearchTree* other, int other_node, WordSet* words, double* max_cost,
                std::optional<Connection>* found);
  bool mayJoin(int node, const SearchTree& other, int other_node, const SteeringWord& word) const;
  bool confirm(int node);
  void grow(int node, double max_cost);
  void addChild(int parent, const ArcSegment& arc, double max_cost);
  std::uint64_t keyOf(const Pose2d& pose, int gear) const;
  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }

  const Scene& scene_;
  Pose2d root_;
  int root_gear_;
  Reach root_reach_;
  const DistanceMap& map_;
  SearchLevel level_{};
  std::vector<Node> nodes_;
  std::vector<Entry> queue_;
  CellNodes by_cell_;
  int advanced_ = 0;  ///< node with the smallest h
};

}  // namespace external_command
