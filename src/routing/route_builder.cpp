// SPDX-License-Identifier: Apache-2.0
#include "route_builder.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "abreast.h"

namespace external_command {

namespace {

constexpr double kMaxChangeRoom = 100.0;  // [m]
constexpr double kTiny = 1e-6;            // [m]

/// A stretch of lane, and where it lies on the way: `x` is the distance driven from the start.
struct Piece {
  LaneIndex lane = 0;
  double from = 0.0, to = 0.0;      // on the lane [m]
  double x_from = 0.0, x_to = 0.0;  // [m]

  double sAt(double x) const {
    return x_to > x_from ? from + (std::clamp(x, x_from, x_to) - x_from) * (to - from) / (x_to - x_from) : from;
  }
  double xAt(double s) const { return to > from ? x_from + (s - from) * (x_to - x_from) / (to - from) : x_from; }
};

using Chain = std::vector<Piece>;

struct Change {
  LaneChange side;
  LanePoint begin;     // the earliest place on the old lane ...
  double x;            // ... and where that is on the way [m]
  double length;       // the least it needs [m]
  std::size_t onto;    // first piece of the course on the new lane
  Chain old_lane;      // from `begin` on, as far as the change can be under way
  double from = 0.0;   // the room it gets on the way ...
  double until = 0.0;  // ... [m]

  double lastEnd() const { return std::max(x + length, old_lane.back().x_to); }
};

/// The lanes as the search counts them: the course jumps to the new lane where a change begins at the earliest.
struct Course {
  Chain pieces;
  std::vector<Change> changes;
  std::vector<double> stops;  // way points and the goal, where changes must be done [m]
};

void beginPiece(LaneIndex lane, double s, Chain* pieces) {
  const double x = pieces->empty() ? 0.0 : pieces->back().x_to;
  pieces->push_back({lane, s, s, x, x});
}

void extendTo(double s, Chain* pieces) {
  Piece& last = pieces->back();
  last.x_to += s - last.to;
  last.to = s;
}

void addLabel(const LaneGraph& graph, const SearchLabel& label, Course* course) {
  using Move = SearchLabel::Move;
  Chain& pieces = course->pieces;
  if (label.move == Move::kStart) {
    if (pieces.empty()) return beginPiece(label.lane, label.s, &pieces);
    return course->stops.push_back(pieces.back().x_to);
  }
  if (label.move == Move::kFollow) {
    extendTo(graph.length(pieces.back().lane), &pieces);
    return beginPiece(label.lane, label.s, &pieces);
  }
  if (label.move == Move::kChange) {
    extendTo(label.change_s, &pieces);
    const LanePoint begin{pieces.back().lane, label.change_s};
    course->changes.push_back({label.side, begin, pieces.back().x_to, label.change_length, pieces.size(), {}});
    beginPiece(label.lane, label.from_s, &pieces);
  }
  if (label.move == Move::kContinue) {
    course->changes.back().length = label.change_length;
    if (label.lane != pieces.back().lane) beginPiece(label.lane, label.from_s, &pieces);
  }
  extendTo(label.s, &pieces);
}

/// Lays out the lane that a change leaves, piece by piece beside the lanes it leads onto.
class OldLane {
 public:
  OldLane(const LaneGraph& graph, const BlockedLanes& blocked, const Change& change)
      : graph_(graph), blocked_(blocked), side_(change.side), place_(change.begin) {}

  /// @return up to `x_end`, or to where the lanes part.
  Chain beside(const Chain& new_lane, double x_end) {
    for (const Piece& piece : new_lane) {
      if (!goBeside(piece) || (!chain_.empty() && chain_.back().x_to > x_end)) break;
    }
    if (chain_.empty()) chain_.push_back({place_.lane, place_.s, place_.s, new_lane.front().x_from, x_end});
    if (chain_.back().x_to > x_end) {
      chain_.back().to = chain_.back().sAt(x_end);
      chain_.back().x_to = x_end;
    }
    return chain_;
  }

 private:
  /// @return false where the lanes part before the end of `piece`.
  bool goBeside(const Piece& piece) {
    double new_s = piece.from;
    while (new_s < piece.to - kTiny) {
      const LaneGraph::Neighbour* neighbour = neighbourAt(piece.lane);
      if (neighbour == nullptr) return false;
      const double new_to = std::min(abreastUntil(graph_, blocked_, place_, *neighbour, new_s), piece.to);
      if (new_to < new_s + kTiny) return false;
      const double old_to = std::clamp(neighbour->pair.toA(new_to), place_.s, graph_.length(place_.lane));
      chain_.push_back({place_.lane, place_.s, old_to, piece.xAt(new_s), piece.xAt(new_to)});
      place_.s = old_to;
      new_s = new_to;
    }
    return true;
  }

  /// `new_lane` as the neighbour of the old lane, or, where the old one is at its end, of a lane that follows it.
  const LaneGraph::Neighbour* neighbourAt(LaneIndex new_lane) {
    if (place_.s < graph_.length(place_.lane) - kTiny) return graph_.findNeighbour(place_.lane, new_lane, side_);
    for (const LaneGraph::Link& next : graph_.successors(place_.lane)) {
      const LaneGraph::Neighbour* neighbour = graph_.findNeighbour(next.lane, new_lane, side_);
      if (neighbour == nullptr) continue;
      place_ = {next.lane, next.entry};
      return neighbour;
    }
    return nullptr;
  }

  const LaneGraph& graph_;
  const BlockedLanes& blocked_;
  const LaneChange side_;
  LanePoint place_;
  Chain chain_;
};

/// The lanes that change `k` leads onto, from its earliest beginning to where the lanes after it may still be under
/// way.
Chain newLane(const Course& course, std::size_t k) {
  const bool is_last = k + 1 == course.changes.size();
  const auto begin = course.pieces.begin() + static_cast<std::ptrdiff_t>(course.changes[k].onto);
  if (is_last) return {begin, course.pieces.end()};
  const Change& next = course.changes[k + 1];
  Chain chain(begin, course.pieces.begin() + static_cast<std::ptrdiff_t>(next.onto));
  chain.insert(chain.end(), next.old_lane.begin(), next.old_lane.end());
  return chain;
}

/// From the last change to the first, as the lane that one leaves is the lane that the one before it leads onto.
void layOutOldLanes(const LaneGraph& graph, const BlockedLanes& blocked, Course* course) {
  for (std::size_t k = course->changes.size(); k-- > 0;) {
    Change& change = course->changes[k];
    const double least = change.x + change.length;
    const auto stop = std::lower_bound(course->stops.begin(), course->stops.end(), least - kTiny);
    const double x_end = std::min(stop == course->stops.end() ? least : *stop, change.x + kMaxChangeRoom);
    change.old_lane = OldLane(graph, blocked, change).beside(newLane(*course, k), std::max(x_end, least));
  }
}

/// Gives each change all the room there is; changes that could be under way at the same place share it evenly.
void shareRoom(std::vector<Change>* changes) {
  const std::size_t count = changes->size();
  std::vector<double> latest(count);
  for (std::size_t k = count; k-- > 0;) {
    latest[k] = (*changes)[k].lastEnd();
    if (k + 1 < count) latest[k] = std::min(latest[k], latest[k + 1] - (*changes)[k + 1].length);
  }
  double done = 0.0;
  for (std::size_t k = 0; k < count; ++k) {
    Change& change = (*changes)[k];
    std::size_t last = k;
    while (last + 1 < count && (*changes)[last + 1].x < (*changes)[last].lastEnd()) ++last;
    change.from = std::max(change.x, done);
    const double even = change.from + (latest[last] - change.from) / static_cast<double>(last - k + 1);
    const double undisturbed = k == last ? latest[k] : (*changes)[k + 1].x;
    change.until = std::min(latest[k], std::max({even, undisturbed, change.from + change.length}));
    done = change.until;
  }
}

bool goesOn(const LaneRange& first, const LaneRange& second) {
  return first.lane == second.lane && std::abs(first.to_s - second.from_s) < kTiny;
}

/// What of `chain` lies between the two places on the way; begins with the end point of a piece where that is all of
/// it.
std::vector<LaneRange> slice(const Chain& chain, double x_from, double x_to) {
  std::vector<LaneRange> ranges;
  for (const Piece& piece : chain) {
    if (piece.x_to < x_from - kTiny) continue;
    if (piece.x_from > x_to - kTiny && !ranges.empty()) break;
    const double to = std::min(piece.to, piece.sAt(x_to));
    const LaneRange range{piece.lane, std::min(std::max(piece.from, piece.sAt(x_from)), to), to};
    if (!ranges.empty() && goesOn(ranges.back(), range)) {
      ranges.back().to_s = range.to_s;
    } else {
      ranges.push_back(range);
    }
  }
  return ranges;
}

double lengthOf(const std::vector<LaneRange>& ranges) {
  double length = 0.0;
  for (const LaneRange& range : ranges) length += range.to_s - range.from_s;
  return length;
}

void append(const LaneRange& range, std::vector<RouteStep>* steps) {
  if (!steps->empty() && steps->back().change_after == LaneChange::kNone) {
    RouteStep& last = steps->back();
    if (goesOn({last.lane, last.from_s, last.to_s}, range)) {
      last.to_s = range.to_s;
      return;
    }
  } else if (!steps->empty() && !steps->back().change_onto.empty()) {
    const LaneRange arrival = steps->back().change_onto.back();  // a change that is done at the very end of a lane
    if (arrival.lane != range.lane) steps->push_back({arrival.lane, arrival.to_s, arrival.to_s});
  }
  steps->push_back({range.lane, range.from_s, range.to_s});
}

void append(const std::vector<LaneRange>& ranges, std::vector<RouteStep>* steps) {
  for (const LaneRange& range : ranges) append(range, steps);
}

std::vector<RouteStep> stepsOf(const Course& course) {
  std::vector<RouteStep> steps;
  const auto piece = [&](std::size_t index) { return course.pieces.begin() + static_cast<std::ptrdiff_t>(index); };
  double x = 0.0;
  std::size_t onto = 0;
  for (std::size_t k = 0; k < course.changes.size(); ++k) {
    const Change& change = course.changes[k];
    if (x < change.x || steps.empty()) append(slice(Chain(piece(onto), piece(change.onto)), x, change.x), &steps);
    const std::vector<LaneRange> under_way = slice(change.old_lane, change.from, change.until);
    append(under_way, &steps);
    steps.back().change_after = change.side;
    steps.back().change_room = lengthOf(under_way);
    steps.back().change_onto = slice(newLane(course, k), change.from, change.until);
    x = change.until;
    onto = change.onto;
  }
  append(slice(Chain(piece(onto), course.pieces.end()), x, course.pieces.back().x_to + 1.0), &steps);
  return steps;
}

}  // namespace

Route buildRoute(const LaneGraph& graph, const BlockedLanes& blocked, const std::vector<SearchLabel>& labels) {
  Course course;
  for (const SearchLabel& label : labels) addLabel(graph, label, &course);
  course.stops.push_back(course.pieces.back().x_to);
  layOutOldLanes(graph, blocked, &course);
  shareRoom(&course.changes);
  Route route;
  route.steps = stepsOf(course);
  route.distance = labels.back().distance;
  route.cost = labels.back().cost;
  route.start = static_cast<std::size_t>(labels.front().candidate);
  for (const SearchLabel& label : labels) {
    if (label.move == SearchLabel::Move::kArrive) route.via.push_back(static_cast<std::size_t>(label.candidate));
  }
  route.goal = route.via.back();
  route.via.pop_back();
  return route;
}

}  // namespace external_command
