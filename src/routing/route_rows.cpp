// SPDX-License-Identifier: Apache-2.0
#include "route_rows.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kTiny = 1e-6;  // [m]

double lengthOf(const LaneRange& range) { return range.to_s - range.from_s; }

}  // namespace

void RouteRow::add(const LaneRange& range) {
  length += lengthOf(range);
  const bool goes_on =
      !pieces.empty() && pieces.back().lane == range.lane && std::abs(pieces.back().to_s - range.from_s) < kTiny;
  if (goes_on) {
    pieces.back().to_s = range.to_s;
  } else {
    pieces.push_back(range);
  }
}

double RouteRow::pieceEndAt(double position) const {
  double end = 0.0;
  for (const LaneRange& piece : pieces) {
    end += lengthOf(piece);
    if (end > position - kTiny) return end;
  }
  return end;
}

LaneRange RouteRow::pointAt(double position) const {
  double begin = 0.0;
  for (const LaneRange& piece : pieces) {
    const double end = begin + lengthOf(piece);
    if (end > position - kTiny || &piece == &pieces.back()) {
      const double s = std::clamp(piece.from_s + position - begin, piece.from_s, piece.to_s);
      return {piece.lane, s, s};
    }
    begin = end;
  }
  return {};
}

std::vector<LaneRange> RouteRow::slice(double begin, double end) const {
  std::vector<LaneRange> ranges;
  double piece_begin = 0.0;
  for (const LaneRange& piece : pieces) {
    const double piece_end = piece_begin + lengthOf(piece);
    const double from = std::max(begin, piece_begin), to = std::min(end, piece_end);
    const bool is_point = lengthOf(piece) < kTiny && to > from - kTiny && (from > begin + kTiny || piece_begin == 0.0);
    if (to - from > kTiny || is_point) {
      ranges.push_back({piece.lane, piece.from_s + from - piece_begin, piece.from_s + to - piece_begin});
    }
    piece_begin = piece_end;
  }
  return ranges;
}

std::vector<RouteRow> rowsOf(const Route& route) {
  std::vector<RouteRow> rows(1);
  for (const RouteStep& step : route.steps) {
    RouteRow& row = rows.back();
    row.add({step.lane, step.from_s, step.to_s});
    row.leave = row.length - step.change_room;
    if (step.change_after == LaneChange::kNone) continue;
    row.change = step.change_after;
    RouteRow next;
    for (const LaneRange& range : step.change_onto) next.add(range);
    next.onto = next.leave = next.length;
    rows.push_back(std::move(next));
  }
  return rows;
}

}  // namespace external_command
