// SPDX-License-Identifier: Apache-2.0
#include "route_search.h"

#include <algorithm>
#include <cmath>

#include "abreast.h"

namespace external_command {

namespace {

constexpr double kChangePrice = 0.01;    // [m] per lane change: routes that differ by less count as equal
constexpr double kSamePlace = 0.001;     // [m]
constexpr double kTiny = 1e-9;           // [m]
constexpr int kMaxChangePieces = 64;     // over which one change may run
constexpr unsigned kPollInterval = 256;  // labels between two looks at the cancel token

/// Sideways by `offset` on two arcs of `radius`: the shortest way, by plane geometry.
double twoArcLength(double offset, double radius) {
  return offset >= 2.0 * radius ? 2.0 * radius : std::sqrt(offset * (4.0 * radius - offset));
}

struct QueueEntry {
  double cost;
  std::int32_t label;
  bool operator<(const QueueEntry& other) const { return cost > other.cost; }  // the cheapest on top
};

struct Target {
  double s;
  std::int32_t candidate;
  std::int32_t next_on_lane;
  bool is_reached;
};

/// What the search knows of a lane; stale where `leg` is not that of the workspace.
struct LaneSlot {
  std::uint64_t leg = 0;
  std::int32_t first_label = -1;
  std::int32_t first_target = -1;
};

/// Memory that outlives a query, so that the next one of this thread need not clear or allocate it.
struct Workspace {
  std::vector<SearchLabel> labels;
  std::vector<QueueEntry> queue;
  std::vector<Target> targets;
  std::vector<LaneSlot> lanes;
  std::uint64_t leg = 0;
};

Workspace& workspaceFor(std::size_t lanes) {
  thread_local Workspace workspace;
  if (workspace.lanes.size() < lanes) workspace.lanes.resize(lanes);
  workspace.labels.clear();
  return workspace;
}

}  // namespace

class RouteSearch::Run {
 public:
  Run(const RouteSearch& search, const BlockedLanes& blocked, const CancelToken& cancel)
      : graph_(search.graph_),
        params_(search.params_),
        rule_(search.rule_),
        blocked_(blocked),
        cancel_(cancel),
        work_(workspaceFor(search.graph_.size())) {}

  SearchResult solve(const RouteQuery& query) {
    SearchResult result;
    std::vector<std::int32_t> ends;
    for (std::size_t leg = 0; leg <= query.via.size(); ++leg) {
      const bool is_last = leg == query.via.size();
      beginLeg(is_last ? query.goals : query.via[leg]);
      if (leg == 0) addStarts(query.starts);
      for (const std::int32_t end : ends) leaveFrom(end);
      ends = drive(is_last);
      if (ends.empty()) {
        result.failed_leg = leg;
        result.reached_lanes = reached_lanes_;
        return result;
      }
    }
    for (std::int32_t i = ends.front(); i >= 0; i = work_.labels[i].parent) result.labels.push_back(work_.labels[i]);
    std::reverse(result.labels.begin(), result.labels.end());
    return result;
  }

 private:
  using Move = SearchLabel::Move;
  using Neighbour = LaneGraph::Neighbour;

  /// A change under way from `old_lane`: `rest` of its `length` [m] is still to be driven, `pieces` pairs of
  /// lanes lie behind.
  struct Crossing {
    LaneIndex old_lane;
    double length;
    double rest;
    double price;
    int pieces;
  };

  void beginLeg(const std::vector<LanePoint>& targets);
  void addStarts(const std::vector<LanePoint>& starts);
  void leaveFrom(std::int32_t arrival);
  std::vector<std::int32_t> drive(bool first_arrival_ends);
  LaneSlot& slotOf(LaneIndex lane);
  void add(SearchLabel label);
  bool isBeaten(const SearchLabel& label, std::int32_t first_on_lane);
  std::int32_t store(const SearchLabel& label);
  void expand(std::int32_t index);
  void arrive(std::int32_t index, const SearchLabel& label);
  void follow(std::int32_t index, const SearchLabel& label);
  void change(std::int32_t index, const SearchLabel& label, const Neighbour& neighbour);
  void change(std::int32_t index, const SearchLabel& label, const Neighbour& neighbour, double length, double price);
  void cross(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part, Crossing crossing);
  void crossOn(std::int32_t index, const LanePair& pair, const Crossing& crossing);

  const LaneGraph& graph_;
  const RouterParams& params_;
  const ChangeRule rule_;
  const BlockedLanes& blocked_;
  const CancelToken& cancel_;
  Workspace& work_;
  std::size_t reached_lanes_ = 0;
};

void RouteSearch::Run::beginLeg(const std::vector<LanePoint>& targets) {
  ++work_.leg;
  work_.queue.clear();
  work_.targets.clear();
  reached_lanes_ = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    LaneSlot& slot = slotOf(targets[i].lane);
    work_.targets.push_back({targets[i].s, static_cast<std::int32_t>(i), slot.first_target, false});
    slot.first_target = static_cast<std::int32_t>(i);
  }
}

void RouteSearch::Run::addStarts(const std::vector<LanePoint>& starts) {
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (blocked_.contains(starts[i].lane, starts[i].s)) continue;
    SearchLabel label;
    label.lane = starts[i].lane;
    label.s = label.anchor_s = starts[i].s;
    label.candidate = static_cast<std::int32_t>(i);
    add(label);
  }
}

void RouteSearch::Run::leaveFrom(std::int32_t arrival) {
  SearchLabel label = work_.labels[arrival];
  label.parent = arrival;
  label.move = Move::kStart;
  label.anchor_s = label.s;
  add(label);
}

/// @return the arrivals at the targets, the nearest first; empty where none can be reached.
std::vector<std::int32_t> RouteSearch::Run::drive(bool first_arrival_ends) {
  std::vector<std::int32_t> arrivals;
  const std::size_t wanted = first_arrival_ends ? 1 : work_.targets.size();
  for (unsigned polls = 0; !work_.queue.empty() && arrivals.size() < wanted; ++polls) {
    if (polls % kPollInterval == 0) cancel_.throwIfCancelled();
    const std::int32_t index = work_.queue.front().label;
    std::pop_heap(work_.queue.begin(), work_.queue.end());
    work_.queue.pop_back();
    SearchLabel& label = work_.labels[index];
    if (label.is_done) continue;
    label.is_done = true;
    if (label.move != Move::kArrive) {
      expand(index);
    } else if (!work_.targets[label.candidate].is_reached) {
      work_.targets[label.candidate].is_reached = true;
      arrivals.push_back(index);
    }
  }
  return arrivals;
}

LaneSlot& RouteSearch::Run::slotOf(LaneIndex lane) {
  LaneSlot& slot = work_.lanes[lane];
  if (slot.leg != work_.leg) slot = {work_.leg, -1, -1};
  return slot;
}

bool RouteSearch::Run::isBeaten(const SearchLabel& label, std::int32_t first_on_lane) {
  for (std::int32_t i = first_on_lane; i >= 0; i = work_.labels[i].next_on_lane) {
    SearchLabel& other = work_.labels[i];
    if (other.free_to != label.free_to) continue;  // a blocked part lies between the two
    const double advantage = (other.cost - other.s) - (label.cost - label.s);
    if (other.s <= label.s + kTiny && advantage <= kTiny) return true;
    if (other.s >= label.s - kTiny && advantage >= -kTiny) other.is_done = true;
  }
  return false;
}

void RouteSearch::Run::add(SearchLabel label) {
  label.free_to = blocked_.freeUntil(label.lane, label.s, graph_.length(label.lane));
  label.is_done = false;
  LaneSlot& slot = slotOf(label.lane);
  if (isBeaten(label, slot.first_label)) return;
  if (slot.first_label < 0) ++reached_lanes_;
  label.next_on_lane = slot.first_label;
  slot.first_label = store(label);
  work_.queue.push_back({label.cost, slot.first_label});
  std::push_heap(work_.queue.begin(), work_.queue.end());
}

std::int32_t RouteSearch::Run::store(const SearchLabel& label) {
  work_.labels.push_back(label);
  return static_cast<std::int32_t>(work_.labels.size()) - 1;
}

void RouteSearch::Run::expand(std::int32_t index) {
  const SearchLabel label = work_.labels[index];  // a copy: the labels move when one is added
  arrive(index, label);
  follow(index, label);
  for (const Neighbour& neighbour : graph_.neighbours(label.lane)) change(index, label, neighbour);
}

void RouteSearch::Run::arrive(std::int32_t index, const SearchLabel& label) {
  for (std::int32_t i = slotOf(label.lane).first_target; i >= 0; i = work_.targets[i].next_on_lane) {
    const Target& target = work_.targets[i];
    if (target.is_reached || target.s < label.s - kSamePlace || target.s > label.free_to) continue;
    SearchLabel arrival = label;
    arrival.s = std::max(label.s, target.s);
    arrival.distance += arrival.s - label.s;
    arrival.cost += arrival.s - label.s;
    arrival.parent = index;
    arrival.move = Move::kArrive;
    arrival.is_done = false;
    arrival.candidate = target.candidate;
    work_.queue.push_back({arrival.cost, store(arrival)});
    std::push_heap(work_.queue.begin(), work_.queue.end());
  }
}

void RouteSearch::Run::follow(std::int32_t index, const SearchLabel& label) {
  const double length = graph_.length(label.lane);
  if (label.free_to < length) return;
  for (const LaneIndex next : graph_.successors(label.lane)) {
    if (blocked_.contains(next, 0.0)) continue;
    SearchLabel entry;
    entry.lane = next;
    entry.distance = label.distance + length - label.s;
    entry.cost = label.cost + length - label.s;
    entry.parent = index;
    entry.move = Move::kFollow;
    add(entry);
  }
}

void RouteSearch::Run::change(std::int32_t index, const SearchLabel& label, const Neighbour& neighbour) {
  if (rule_ == ChangeRule::kWithoutRoom) return change(index, label, neighbour, 0.0, kChangePrice);
  const double roomy = params_.min_lane_change_length;
  const double tight = twoArcLength(neighbour.pair.offset, params_.min_turning_radius);
  change(index, label, neighbour, roomy, kChangePrice);
  if (tight < roomy) change(index, label, neighbour, tight, kChangePrice + params_.tight_lane_change_price);
}

void RouteSearch::Run::change(std::int32_t index, const SearchLabel& label, const Neighbour& neighbour, double length,
                              double price) {
  const LanePair& pair = neighbour.pair;
  const Crossing crossing{label.lane, length, length, price, 0};
  for (const Interval& part : graph_.crossableParts(neighbour)) {
    const Interval old_part{std::max(part.from, label.s), std::min(part.to, label.free_to)};
    if (old_part.to - old_part.from < (length > 0.0 ? kTiny : 0.0)) continue;
    const Interval new_part{pair.toB(old_part.from), pair.toB(old_part.to)};
    if (blocked_.empty()) {
      cross(index, neighbour, old_part.from, new_part, crossing);
      continue;
    }
    for (const Interval& free : blocked_.freeParts(pair.b, new_part.from, new_part.to)) {
      cross(index, neighbour, pair.toA(free.from), free, crossing);
    }
  }
}

/// From `old_s`, abreast of `new_part.from` on the neighbour, across; `new_part` is what can be used for it.
void RouteSearch::Run::cross(std::int32_t index, const Neighbour& neighbour, double old_s, const Interval& new_part,
                             Crossing crossing) {
  const bool begins = crossing.pieces == 0;
  const SearchLabel& parent = work_.labels[index];
  const double room = new_part.to - new_part.from;
  const double anchor = begins ? neighbour.pair.toB(parent.anchor_s) : parent.anchor_s;
  const double to_begin = begins ? (new_part.from - anchor) - (parent.s - parent.anchor_s) : 0.0;
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
  label.anchor_s = begins || label.lane == parent.lane ? anchor : 0.0;
  label.change_length = crossing.length;
  if (room >= crossing.rest - kTiny) return add(label);
  if (new_part.to < neighbour.pair.b_to - kSamePlace || crossing.pieces == kMaxChangePieces) return;
  crossing.rest -= room;
  ++crossing.pieces;
  crossOn(store(label), neighbour.pair, crossing);
}

/// The pair of lanes ends at label `index`, before the change is done: on to the pairs that follow.
void RouteSearch::Run::crossOn(std::int32_t index, const LanePair& pair, const Crossing& crossing) {
  const bool old_ends = pair.a_to > graph_.length(crossing.old_lane) - kSamePlace;
  const bool new_ends = pair.b_to > graph_.length(pair.b) - kSamePlace;
  if (!old_ends && !new_ends) return;
  const auto old_lanes = old_ends ? graph_.successors(crossing.old_lane) : Span<LaneIndex>(&crossing.old_lane);
  const auto new_lanes = new_ends ? graph_.successors(pair.b) : Span<LaneIndex>(&pair.b);
  const double old_s = old_ends ? 0.0 : pair.a_to;
  const double new_s = new_ends ? 0.0 : pair.b_to;
  for (const LaneIndex old_lane : old_lanes) {
    for (const LaneIndex new_lane : new_lanes) {
      const Neighbour* next = graph_.findNeighbour(old_lane, new_lane, pair.side);
      if (next == nullptr) continue;
      const double new_to = abreastUntil(graph_, blocked_, {old_lane, old_s}, *next, new_s);
      if (new_to <= new_s) continue;
      cross(index, *next, old_s, {new_s, new_to}, {old_lane, crossing.length, crossing.rest, 0.0, crossing.pieces});
    }
  }
}

RouteSearch::RouteSearch(const LaneGraph& graph, const RouterParams& params, ChangeRule rule)
    : graph_(graph), params_(params), rule_(rule) {}

SearchResult RouteSearch::run(const RouteQuery& query, const BlockedLanes& blocked, const CancelToken& cancel) const {
  return Run(*this, blocked, cancel).solve(query);
}

}  // namespace external_command
