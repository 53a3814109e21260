// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "change_room.h"
#include "external_command/map/hd_map.h"
#include "lane_pair.h"

namespace external_command {

/// A run of elements inside one flat array.
template <class T>
class Span {
 public:
  Span(const T* begin, const T* end) : begin_(begin), end_(end) {}
  explicit Span(const T* single) : Span(single, single + 1) {}
  const T* begin() const { return begin_; }
  const T* end() const { return end_; }

 private:
  const T *begin_, *end_;
};

/// The routable lanes of a map as flat arrays: which lane leads into which, and which lies beside which. Immutable.
class LaneGraph {
 public:
  /// A lane that follows another, which ends beside `entry` on it [m].
  struct Link {
    LaneIndex lane;
    double entry;
  };

  /// A lane beside another, where the line between them may be crossed, and the room that takes.
  struct Neighbour {
    LanePair pair;
    std::uint32_t first_part, last_part;
    std::uint32_t first_need, last_need;
  };

  LaneGraph(const HdMap& map, const RouterParams& params);

  std::size_t size() const { return lengths_.size(); }
  double length(LaneIndex lane) const { return lengths_[lane]; }
  bool isRoutable(LaneIndex lane) const { return routable_[lane]; }

  Span<Link> successors(LaneIndex lane) const {
    return {links_.successors.data() + links_.first_successor[lane],
            links_.successors.data() + links_.first_successor[lane + 1]};
  }

  Span<Neighbour> neighbours(LaneIndex lane) const {
    return {links_.neighbours.data() + links_.first_neighbour[lane],
            links_.neighbours.data() + links_.first_neighbour[lane + 1]};
  }

  /// Ranges of `s` on the lane that has this neighbour, rising.
  Span<Interval> crossableParts(const Neighbour& neighbour) const {
    return {links_.parts.data() + neighbour.first_part, links_.parts.data() + neighbour.last_part};
  }

  /// The least length of a change that begins at `s` on the lane that has this neighbour [m].
  double changeNeed(const Neighbour& neighbour, double s) const;

  /// Pieces of that lane, by rising `s`, from which on a change takes another length than before.
  Span<ChangeNeed> changeNeeds(const Neighbour& neighbour) const {
    return {links_.needs.data() + neighbour.first_need, links_.needs.data() + neighbour.last_need};
  }

  /// `b` as a neighbour of `a` on this side; nullptr where it is none.
  const Neighbour* findNeighbour(LaneIndex a, LaneIndex b, LaneChange side) const;

 private:
  /// Of lanes in a row; the positions in the arrays are those of the first link of each.
  struct Links {
    /// Adds those of the lanes that follow.
    void append(const Links& next);

    std::vector<std::uint32_t> first_successor, first_neighbour;
    std::vector<Link> successors;
    std::vector<Neighbour> neighbours;
    std::vector<Interval> parts;
    std::vector<ChangeNeed> needs;
  };

  void addLane(const HdMap& map, LaneIndex index, double min_turning_radius, Links* links) const;
  static void addNeighbour(const HdMap& map, LaneIndex a, LaneIndex b, LaneChange side, double min_turning_radius,
                           Links* links);

  std::vector<double> lengths_;
  std::vector<bool> routable_;
  Links links_;
};

}  // namespace external_command
