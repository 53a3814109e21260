// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "blocked_lanes.h"
#include "external_command/core/cancel_token.h"
#include "goal_distances.h"
#include "lane_graph.h"
#include "search_label.h"

namespace external_command {

struct SearchWorkspace;

/// Shortest routes over places on lanes, leg by leg: the cheapest label is settled next (Dijkstra), or, where an index
/// tells how far the targets are at least, the one that promises the cheapest route (A*). Labels are set again where a
/// cheaper way to them is found, so that the bounds need not be consistent.
///
/// A label is a place (lane, s). From it one drives on: to the successors, whose beginning becomes a label, to targets
/// on the lane, and to the neighbour lanes. A change begins where it first can, at the label or where the line becomes
/// crossable, runs over `length` metres during which both lanes lie abreast and are free, over as many pieces of the
/// two lanes as that takes, and ends in a label on the other lane. Beginning a change later than it first can never
/// helps, so these labels are enough. One label beats another on the same lane where it lies further back and whoever
/// drives on from it arrives no later: more than one can be needed per lane, as a place behind a goal does not replace
/// one before it.
///
/// One at a time per thread: the memory of a small search is kept for the next. The arguments must outlive the search.
class LabelSearch {
 public:
  /// How far a leg goes.
  enum class Reach {
    kToFirst,  ///< until the nearest target is reached
    kToAll,    ///< until all are
  };

  /// @param index  nullptr: there is none.
  LabelSearch(const LaneGraph& graph, const RouteIndex* index, const RouterParams& params, ChangeRule rule,
              const BlockedLanes& blocked, const CancelToken& cancel);
  ~LabelSearch();
  LabelSearch(const LabelSearch&) = delete;
  LabelSearch& operator=(const LabelSearch&) = delete;

  void beginLeg(const std::vector<LanePoint>& targets);
  void addStart(const LanePoint& start, std::int32_t candidate);

  /// Starts where an earlier leg ended, at its cost.
  void leaveFrom(std::int32_t arrival);

  /// @return the labels of the targets that can be reached, the cheapest first.
  /// @throws Cancelled
  std::vector<std::int32_t> drive(Reach reach);

  std::size_t reachedLanes() const { return reached_lanes_; }  ///< of this leg
  std::size_t foundLabels() const;                             ///< of all legs

  /// The labels that lead to this one, from the first start on.
  std::vector<SearchLabel> wayTo(std::int32_t index) const;

 private:
  using Move = SearchLabel::Move;
  using Neighbour = LaneGraph::Neighbour;

  /// A change under way from `old_lane`: `rest` of its `length` [m] is still to be driven, `pieces` pairs of lanes lie
  /// behind.
  struct Crossing {
    LaneIndex old_lane;
    double length;
    double rest;
    double price;
    int pieces;
  };

  /// A pair of lanes that the change being looked at has come to.
  struct CrossedPair {
    LaneIndex old_lane;
    LaneIndex new_lane;
    double length, rest;  ///< as in Crossing
  };

  void add(SearchLabel label);
  bool isCrossedAnew(const LanePair& pair, const Crossing& crossing);
  std::int32_t store(const SearchLabel& label);
  void enqueue(std::int32_t index);
  double leastRest(const SearchLabel& label);
  bool isBeaten(const SearchLabel& label, std::int32_t first_on_lane);
  void expand(std::int32_t index);
  void arrive(std::int32_t index, const SearchLabel& label);
  void arrive(std::int32_t index, const SearchLabel& label, std::int32_t target, double s);
  bool isAhead(const LanePoint& point, const LanePoint& place, double reach) const;
  void follow(std::int32_t index, const SearchLabel& label);
  void change(std::int32_t index, const SearchLabel& label, const Neighbour& neighbour);
  void change(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part);
  void change(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part, double need);
  void cross(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part, Crossing crossing);
  void crossOn(std::int32_t index, const LanePair& pair, const Crossing& crossing);
  void crossOn(std::int32_t index, const Neighbour& next, const LaneGraph::Link& old_lane,
               const LaneGraph::Link& new_lane, const Crossing& crossing);

  const LaneGraph& graph_;
  const RouterParams& params_;
  const ChangeRule rule_;
  const BlockedLanes& blocked_;
  const CancelToken& cancel_;
  SearchWorkspace& work_;
  std::optional<GoalDistances> distances_;
  std::vector<CrossedPair> crossed_;
  std::size_t reached_lanes_ = 0;
};

}  // namespace external_command
