// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "external_command/routing/router.h"
#include "route_rows.h"

namespace external_command {

namespace {

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

/// A change between lanes that lie on each other takes no length, but has its place.
std::vector<LaneRange> lanesBetween(const RouteRow& row, double begin, double end) {
  std::vector<LaneRange> lanes = row.slice(begin, end);
  if (lanes.empty()) lanes.push_back(row.pointAt(begin));
  return lanes;
}

}  // namespace

std::vector<RouteSegment> toSegments(const HdMap& map, const Route& route) {
  const std::vector<RouteRow> rows = rowsOf(route);
  SegmentWriter writer(map);
  double done = 0.0;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    writer.addLanes(rows[r].slice(done, rows[r].leave));
    if (rows[r].change == LaneChange::kNone) break;
    const RouteRow &row = rows[r], &next = rows[r + 1];
    done = next.pieceEndAt(next.onto);
    if (next.change != LaneChange::kNone) done = std::min(done, next.leave);
    writer.add({{lanesBetween(row, row.leave, row.length), false, row.change},
                {lanesBetween(next, 0.0, done), true, LaneChange::kNone}});
  }
  return writer.take();
}

}  // namespace external_command
