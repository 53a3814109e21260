// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "external_command/routing/router.h"
#include "route_rows.h"

namespace external_command {

namespace {

/// Whether the route changes on, to the same side, before the lane piece on which it arrived ends.
bool changesOn(const RouteRow& row, const RouteRow& next) {
  return row.change == next.change && next.leave < next.pieceEndAt(next.onto) - 1e-6;
}

class SegmentWriter {
 public:
  explicit SegmentWriter(const HdMap& map) : map_(map) {}

  /// Lanes beside which no change happens: a segment each.
  void addLanes(const std::vector<LaneRange>& lanes) {
    for (const LaneRange& lane : lanes) add({{{lane}, true, LaneChange::kNone}});
  }

  /// Passages in the order in which the route takes them.
  void add(std::vector<RoutePassage> passages) {
    const Lane& first = map_.lane(passages.front().lanes.front().lane);
    if (passages.front().change == LaneChange::kRight) std::reverse(passages.begin(), passages.end());
    segments_.push_back({first.road_id.empty() ? first.id : first.road_id, std::move(passages)});
  }

  std::vector<RouteSegment> take() { return std::move(segments_); }

 private:
  const HdMap& map_;
  std::vector<RouteSegment> segments_;
};

}  // namespace

std::vector<RouteSegment> toSegments(const HdMap& map, const Route& route) {
  const std::vector<RouteRow> rows = rowsOf(route);
  SegmentWriter writer(map);
  double done = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    writer.addLanes(rows[r].slice(done, rows[r].leave));
    if (rows[r].change == LaneChange::kNone) break;
    std::vector<RoutePassage> passages = {{rows[r].slice(rows[r].leave, rows[r].length), false, rows[r].change}};
    while (changesOn(rows[r], rows[r + 1])) {
      ++r;
      passages.push_back({rows[r].slice(0.0, rows[r].length), false, rows[r].change});
    }
    const RouteRow& last = rows[r + 1];
    done = last.pieceEndAt(last.onto);
    if (last.change != LaneChange::kNone) done = std::min(done, last.leave);
    passages.push_back({last.slice(0.0, done), true, LaneChange::kNone});
    writer.add(std::move(passages));
  }
  return writer.take();
}

}  // namespace external_command
