// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "distance_map.h"
#include "free_space/manoeuvre.h"
#include "pose_cells.h"

namespace external_command {

/// Ways for a body that is as long and as wide as the vehicle, and that can also turn on the spot and step sideways: a
/// hybrid A* whose steps are the vehicle's arcs and these two. The vehicle can follow such a way by driving to and fro,
/// where there is room around it; so what it can drive costs its length, the rest costs more, and more where there is
/// little room.
class HolonomicSearch {
 public:
  /// @param map  of the ways past the obstacles to `to`. The rear axle stays where it leads there.
  HolonomicSearch(const Scene& scene, const Pose2d& from, const Pose2d& to, const DistanceMap& map);

  /// The poses of a way from the first one to the last, free, a step apart; the last step is less than a cell. Empty
  /// where none was found, or once `stop`, which is asked at every step, says so.
  std::vector<Pose2d> way(const std::function<bool()>& stop);

  /// Makes it dear to turn on the spot and to step sideways near a pose.
  void avoid(const Pose2d& pose) { avoided_.push_back(pose); }

 private:
  /// How finely to search.
  struct Level {
    double cell;            ///< side of a cell, and length of a step sideways [m]
    double heading_cell;    ///< and angle of a turn on the spot [rad]
    double stride;          ///< length of an arc [m]
    std::size_t max_nodes;  ///< then the level is given up
  };
  static const std::vector<Level>& levels();

  struct Node {
    Pose2d pose;
    double g;  ///< cost from the first pose [m]
    int parent;
    bool closed = false;
  };

  struct Entry {
    double f;
    int node;
    bool operator<(const Entry& other) const { return f > other.f; }
  };

  bool search(const std::function<bool()>& stop, std::vector<Pose2d>* way);
  int takeBest();
  void grow(int node);
  void drive(int node, const ArcSegment& arc);
  void shift(int node, const Pose2d& to, double length, double price);
  double priceFactor(const Pose2d& from, const Pose2d& to) const;
  bool isBetter(const Pose2d& pose, double g) const;
  void add(int parent, const Pose2d& pose, double g);
  double costLeft(const Pose2d& pose) const;
  std::uint64_t cellAt(const Pose2d& pose) const { return cellOf(pose, level_.cell, level_.heading_cell); }
  std::vector<Pose2d> wayTo(int node) const;
  Node& at(int node) { return nodes_[static_cast<std::size_t>(node)]; }
  const Node& at(int node) const { return nodes_[static_cast<std::size_t>(node)]; }

  const Scene& scene_;
  Pose2d from_, to_;
  const DistanceMap& map_;
  std::vector<Pose2d> avoided_;
  Level level_{};
  std::vector<Node> nodes_;
  std::vector<Entry> queue_;
  CellNodes by_cell_;
};

}  // namespace external_command
