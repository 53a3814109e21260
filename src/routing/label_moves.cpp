// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "abreast.h"
#include "label_search.h"
#include "search_workspace.h"

namespace external_command {

namespace {

constexpr double kLeastChangePrice = 0.01;  // [m]: of routes that are equally long the one with fewer changes counts
constexpr double kLateChangePrice =
    1e-8;                             // per metre driven before it: of equal routes the one that changes early counts
constexpr double kSamePlace = 0.001;  // [m]
constexpr double kTiny = 1e-9;        // [m]
constexpr int kMaxChangePieces = 64;  // over which one change may run
constexpr std::size_t kMaxCrossedPairs = 256;  // of one change, whatever ways it could take
constexpr int kMaxLanesBehind = 5;             // over which a place behind a start is looked for

}  // namespace

void LabelSearch::expand(std::int32_t index) {
  const SearchLabel label = work_.labels[index];  // a copy: the labels move when one is added
  arrive(index, label);
  follow(index, label);
  for (const Neighbour& neighbour : graph_.neighbours(label.lane)) change(index, label, neighbour);
}

void LabelSearch::arrive(std::int32_t index, const SearchLabel& label) {
  for (std::int32_t i = work_.slotOf(label.lane).first_target; i >= 0; i = work_.targets[i].next_on_lane) {
    const LanePoint place = work_.targets[i].place;
    if (place.s >= label.s - kSamePlace && place.s <= label.free_to) arrive(index, label, i, place.s);
  }
  if (label.move != Move::kStart) return;
  const LanePoint here{label.lane, label.s};
  // The way point before may itself lie behind the place where it counted as reached.
  const LanePoint before = label.parent < 0 ? here : work_.reached_targets[label.candidate].place;
  for (std::size_t i = 0; i < work_.targets.size(); ++i) {
    const LanePoint place = work_.targets[i].place;
    if (blocked_.contains(place.lane, place.s)) continue;
    if (isAhead(here, place, params_.stopping_error) || isAhead(before, place, params_.stopping_error)) {
      arrive(index, label, static_cast<std::int32_t>(i), label.s);
    }
  }
}

void LabelSearch::arrive(std::int32_t index, const SearchLabel& label, std::int32_t target, double s) {
  if (work_.targets[target].is_reached) return;
  SearchLabel arrival = label;
  arrival.s = std::max(label.s, s);
  arrival.distance += arrival.s - label.s;
  arrival.cost += arrival.s - label.s + work_.targets[target].place.price;
  arrival.parent = index;
  arrival.move = Move::kArrive;
  arrival.is_done = false;
  arrival.candidate = work_.targets[target].candidate;
  enqueue(store(arrival));
}

/// Whether `point` lies at most `reach` [m] ahead of `place`, on its lane or those that follow.
bool LabelSearch::isAhead(const LanePoint& point, const LanePoint& place, double reach) const {
  if (point.lane == place.lane && point.s >= place.s) return point.s - place.s <= reach;
  if (graph_.length(place.lane) - place.s > reach) return false;
  std::map<std::pair<LaneIndex, double>, double> open{{{place.lane, place.s}, reach}};  // reach left at each place
  for (int lanes = 0; lanes < kMaxLanesBehind && !open.empty(); ++lanes) {
    std::map<std::pair<LaneIndex, double>, double> next;
    for (const auto& [at, left] : open) {
      const double rest = left - (graph_.length(at.first) - at.second);
      if (rest < 0.0) continue;
      for (const LaneGraph::Link& link : graph_.successors(at.first)) {
        if (link.lane == point.lane && point.s >= link.entry && point.s - link.entry <= rest) return true;
        double& most = next.try_emplace({link.lane, link.entry}, rest).first->second;
        most = std::max(most, rest);
      }
    }
    open = std::move(next);
  }
  return false;
}

void LabelSearch::follow(std::int32_t index, const SearchLabel& label) {
  const double length = graph_.length(label.lane);
  if (label.free_to < length) return;
  for (const LaneGraph::Link& next : graph_.successors(label.lane)) {
    if (blocked_.contains(next.lane, next.entry)) continue;
    SearchLabel entry;
    entry.lane = next.lane;
    entry.s = entry.anchor_s = next.entry;
    entry.distance = label.distance + length - label.s;
    entry.cost = label.cost + length - label.s;
    entry.parent = index;
    entry.move = Move::kFollow;
    add(entry);
  }
}

void LabelSearch::change(std::int32_t index, const SearchLabel& label, const Neighbour& neighbour) {
  const LanePair& pair = neighbour.pair;
  for (const Interval& part : graph_.crossableParts(neighbour)) {
    const Interval old_part{std::max(part.from, label.s), std::min(part.to, label.free_to)};
    if (old_part.to - old_part.from < (rule_ == ChangeRule::kWithRoom ? kTiny : 0.0)) continue;
    const Interval new_part{pair.toB(old_part.from), pair.toB(old_part.to)};
    if (blocked_.empty()) {
      change(index, neighbour, old_part.from, new_part);
      continue;
    }
    for (const Interval& free : blocked_.freeParts(pair.b, new_part.from, new_part.to)) {
      change(index, neighbour, pair.toA(free.from), free);
    }
  }
}

/// Where the lanes come nearer to each other, or a bend ends, a change that begins there may be done earlier than one
/// that begins where it first can, at `old_s`.
void LabelSearch::change(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part) {
  if (rule_ == ChangeRule::kWithoutRoom) return change(index, neighbour, old_s, new_part, 0.0);
  double need = graph_.changeNeed(neighbour, old_s);
  change(index, neighbour, old_s, new_part, need);
  for (const ChangeNeed& next : graph_.changeNeeds(neighbour)) {
    const auto later_s = static_cast<double>(next.s);
    const double later_new_s = neighbour.pair.toB(later_s);
    if (later_s <= old_s || static_cast<double>(next.length) >= need || later_new_s >= new_part.to) continue;
    need = graph_.changeNeed(neighbour, later_s);
    change(index, neighbour, later_s, {later_new_s, new_part.to}, need);
  }
}

void LabelSearch::change(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part,
                         double need) {
  const double price =
      std::max(params_.lane_change_price, kLeastChangePrice) + kLateChangePrice * work_.labels[index].distance;
  const double length = rule_ == ChangeRule::kWithoutRoom ? 0.0 : std::max(params_.min_lane_change_length, need);
  const LaneIndex lane = work_.labels[index].lane;
  crossed_.clear();
  cross(index, neighbour, old_s, new_part, {lane, length, length, price, 0});
  if (need >= length) return;
  crossed_.clear();
  cross(index, neighbour, old_s, new_part, {lane, need, need, price + params_.tight_lane_change_price, 0});
}

/// From `old_s`, abreast of `new_part.from` on the neighbour, across; `new_part` is what can be used for it.
void LabelSearch::cross(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part,
                        Crossing crossing) {
  const bool begins = crossing.pieces == 0;
  const SearchLabel& parent = work_.labels[index];
  const double room = new_part.to - new_part.from;
  const double old_anchor = std::max(parent.anchor_s, neighbour.pair.a_from);
  const double anchor = begins ? neighbour.pair.toB(old_anchor) : parent.anchor_s;
  const double to_begin = begins ? (new_part.from - anchor) - (parent.s - old_anchor) : 0.0;
  const double driven = to_begin + std::min(room, crossing.rest);
  SearchLabel label;
  label.lane = neighbour.pair.b;
  label.s = new_part.from + std::min(room, crossing.rest);
  label.distance = parent.distance + driven;
  label.cost = parent.cost + driven + (begins ? crossing.price : 0.0);
  label.parent = index;
  label.move = begins ? Move::kChange : Move::kContinue;
  label.side = neighbour.pair.side;
  label.change_s = old_s;
  label.from_s = new_part.from;
  label.anchor_s = begins || label.lane == parent.lane ? anchor : new_part.from;
  label.change_length = crossing.length;
  if (room >= crossing.rest - kTiny) return add(label);
  if (new_part.to < neighbour.pair.b_to - kSamePlace || crossing.pieces == kMaxChangePieces) return;
  crossing.rest -= room;
  ++crossing.pieces;
  if (!isCrossedAnew(neighbour.pair, crossing)) return;
  crossOn(store(label), neighbour.pair, crossing);
}

/// Lanes that part and join again lead to the same pair on many ways; those as far on as an earlier one add nothing.
bool LabelSearch::isCrossedAnew(const LanePair& pair, const Crossing& crossing) {
  const auto isAlike = [&](const CrossedPair& crossed) {
    return crossed.old_lane == crossing.old_lane && crossed.new_lane == pair.b &&
           std::abs(crossed.length - crossing.length) < kSamePlace &&
           std::abs(crossed.rest - crossing.rest) < kSamePlace;
  };
  if (crossed_.size() == kMaxCrossedPairs || std::any_of(crossed_.begin(), crossed_.end(), isAlike)) return false;
  crossed_.push_back({crossing.old_lane, pair.b, crossing.length, crossing.rest});
  return true;
}

/// The pair of lanes ends at label `index`, before the change is done: on to the pairs that follow.
void LabelSearch::crossOn(std::int32_t index, const LanePair& pair, const Crossing& crossing) {
  const bool old_ends = pair.a_to > graph_.length(crossing.old_lane) - kSamePlace;
  const bool new_ends = pair.b_to > graph_.length(pair.b) - kSamePlace;
  if (!old_ends && !new_ends) return;
  const LaneGraph::Link old_link{crossing.old_lane, pair.a_to}, new_link{pair.b, pair.b_to};
  const auto old_links = old_ends ? graph_.successors(crossing.old_lane) : Span<LaneGraph::Link>(&old_link);
  const auto new_links = new_ends ? graph_.successors(pair.b) : Span<LaneGraph::Link>(&new_link);
  for (const LaneGraph::Link& old_lane : old_links) {
    for (const LaneGraph::Link& new_lane : new_links) {
      const Neighbour* next = graph_.findNeighbour(old_lane.lane, new_lane.lane, pair.side);
      if (next != nullptr) crossOn(index, *next, old_lane, new_lane, crossing);
    }
  }
}

void LabelSearch::crossOn(std::int32_t index, const Neighbour& next, const LaneGraph::Link& old_lane,
                          const LaneGraph::Link& new_lane, const Crossing& crossing) {
  const double old_s = old_lane.entry, new_s = new_lane.entry;
  const double new_to = abreastUntil(graph_, blocked_, {old_lane.lane, old_s}, next, new_s);
  if (new_to <= new_s) return;
  // The lanes may part, or bend, further on.
  const bool needs_room = rule_ == ChangeRule::kWithRoom;
  const double more = needs_room ? std::max(0.0, graph_.changeNeed(next, old_s) - crossing.length) : 0.0;
  cross(index, next, old_s, {new_s, new_to},
        {old_lane.lane, crossing.length + more, crossing.rest + more, 0.0, crossing.pieces});
}

}  // namespace external_command
