// SPDX-License-Identifier: Apache-2.0
#include "label_search.h"

#include <algorithm>

#include "search_workspace.h"

namespace external_command {

namespace {

constexpr double kTiny = 1e-9;           // [m]
constexpr unsigned kPollInterval = 256;  // labels between two looks at the cancel token

SearchWorkspace& workspaceFor(std::size_t lanes) {
  thread_local SearchWorkspace workspace;
  if (workspace.lanes.size() < lanes) workspace.lanes.resize(lanes);
  workspace.labels.clear();
  return workspace;
}

}  // namespace

LabelSearch::LabelSearch(const LaneGraph& graph, const RouteIndex* index, const RouterParams& params, ChangeRule rule,
                         const BlockedLanes& blocked, const CancelToken& cancel)
    : graph_(graph),
      params_(params),
      rule_(rule),
      blocked_(blocked),
      cancel_(cancel),
      work_(workspaceFor(graph.size())) {
  if (index != nullptr) distances_.emplace(graph, *index);
}

LabelSearch::~LabelSearch() { work_.giveBack(); }

void LabelSearch::beginLeg(const std::vector<LanePoint>& targets) {
  ++work_.leg;
  work_.queue.clear();
  work_.reached_targets.swap(work_.targets);
  work_.targets.clear();
  reached_lanes_ = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    SearchWorkspace::LaneSlot& slot = work_.slotOf(targets[i].lane);
    work_.targets.push_back({targets[i], static_cast<std::int32_t>(i), slot.first_target, false});
    slot.first_target = static_cast<std::int32_t>(i);
  }
  if (distances_) distances_->setTargets(targets);
}

void LabelSearch::addStart(const LanePoint& start, std::int32_t candidate) {
  if (blocked_.contains(start.lane, start.s)) return;
  SearchLabel label;
  label.lane = start.lane;
  label.s = label.anchor_s = start.s;
  label.cost = start.price;
  label.candidate = candidate;
  add(label);
}

void LabelSearch::leaveFrom(std::int32_t arrival) {
  SearchLabel label = work_.labels[arrival];
  label.parent = arrival;
  label.move = Move::kStart;
  label.anchor_s = label.s;
  add(label);
}

std::vector<std::int32_t> LabelSearch::drive(Reach reach) {
  std::vector<std::int32_t> arrivals;
  const std::size_t wanted = reach == Reach::kToFirst ? 1 : work_.targets.size();
  for (unsigned polls = 0; !work_.queue.empty() && arrivals.size() < wanted; ++polls) {
    if (polls % kPollInterval == 0) cancel_.throwIfCancelled();
    const std::int32_t index = work_.queue.front().label;
    std::pop_heap(work_.queue.begin(), work_.queue.end());
    work_.queue.pop_back();
    SearchLabel& label = work_.labels[index];
    if (label.is_done) continue;
    label.is_done = true;
    if (label.move == Move::kArrive) {
      if (work_.targets[label.candidate].is_reached) continue;
      work_.targets[label.candidate].is_reached = true;
      arrivals.push_back(index);
    } else {
      expand(index);
    }
  }
  return arrivals;
}

std::vector<SearchLabel> LabelSearch::wayTo(std::int32_t index) const {
  std::vector<SearchLabel> way;
  for (; index >= 0; index = work_.labels[index].parent) way.push_back(work_.labels[index]);
  std::reverse(way.begin(), way.end());
  return way;
}

std::size_t LabelSearch::foundLabels() const { return work_.labels.size(); }

bool LabelSearch::isBeaten(const SearchLabel& label, std::int32_t first_on_lane) {
  for (std::int32_t i = first_on_lane; i >= 0; i = work_.labels[i].next_on_lane) {
    SearchLabel& other = work_.labels[i];
    if (other.free_to != label.free_to) continue;  // a blocked part lies between the two
    const double advantage = (other.cost - other.s) - (label.cost - label.s);
    if (other.s <= label.s + kTiny && advantage <= kTiny) return true;
    if (other.s >= label.s - kTiny && advantage >= -kTiny) other.is_done = true;
  }
  return false;
}

void LabelSearch::add(SearchLabel label) {
  label.free_to = blocked_.freeUntil(label.lane, label.s, graph_.length(label.lane));
  label.is_done = false;
  SearchWorkspace::LaneSlot& slot = work_.slotOf(label.lane);
  if (isBeaten(label, slot.first_label)) return;
  if (slot.first_label < 0) ++reached_lanes_;
  label.next_on_lane = slot.first_label;
  slot.first_label = store(label);
  enqueue(slot.first_label);
}

std::int32_t LabelSearch::store(const SearchLabel& label) {
  work_.labels.push_back(label);
  return static_cast<std::int32_t>(work_.labels.size()) - 1;
}

void LabelSearch::enqueue(std::int32_t index) {
  const SearchLabel& label = work_.labels[index];
  work_.queue.push_back({label.cost + leastRest(label), index});
  std::push_heap(work_.queue.begin(), work_.queue.end());
}

/// What it takes from here to the nearest target at least [m]. From where a leg starts, also targets just behind are
/// reached: nothing is known.
double LabelSearch::leastRest(const SearchLabel& label) {
  if (!distances_ || label.move == Move::kStart || label.move == Move::kArrive) return 0.0;
  return distances_->from(label.lane, label.anchor_s) - (label.s - label.anchor_s);
}

}  // namespace external_command
