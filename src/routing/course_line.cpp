// SPDX-License-Identifier: Apache-2.0
#include "course_line.h"

#include <algorithm>

#include "line_mending.h"

namespace external_command {

namespace {

class LineBuilder {
 public:
  LineBuilder(const HdMap& map, double default_limit) : map_(map), default_limit_(default_limit) {}

  std::size_t size() const { return line_.points.size(); }

  void add(const LaneRange& range) {
    const Lane& lane = map_.lane(range.lane);
    const double limit = lane.speed_limit > 0.0 ? lane.speed_limit : default_limit_;
    const std::vector<double>& s = lane.center.arcLengths();
    add(lane.center.pointAt(range.from_s), limit, {range.lane, range.from_s});
    for (auto next = std::upper_bound(s.begin(), s.end(), range.from_s); next != s.end() && *next < range.to_s;
         ++next) {
      add(lane.center.points()[static_cast<std::size_t>(next - s.begin())], limit, {range.lane, *next});
    }
    add(lane.center.pointAt(range.to_s), limit, {range.lane, range.to_s});
  }

  void dropLast() {
    line_.points.pop_back();
    line_.limits.pop_back();
    line_.lanes.pop_back();
  }

  /// From point `begin` on.
  void dropFolds(std::size_t begin) {
    const std::vector<std::size_t> kept =
        withoutFolds({line_.points.begin() + static_cast<std::ptrdiff_t>(begin), line_.points.end()});
    for (std::size_t i = 0; i < kept.size(); ++i) {
      line_.points[begin + i] = line_.points[begin + kept[i]];
      line_.limits[begin + i] = line_.limits[begin + kept[i]];
      line_.lanes[begin + i] = line_.lanes[begin + kept[i]];
    }
    line_.points.resize(begin + kept.size());
    line_.limits.resize(begin + kept.size());
    line_.lanes.resize(begin + kept.size());
  }

  /// The route goes from point `begin` to point `end`.
  CourseLine take(std::size_t begin, std::size_t end) {
    line_.s.resize(line_.points.size(), 0.0);
    for (std::size_t i = 1; i < line_.points.size(); ++i) {
      line_.s[i] = line_.s[i - 1] + (line_.points[i] - line_.points[i - 1]).norm();
    }
    const double start = line_.s[begin];
    for (double& s : line_.s) s -= start;
    line_.end = line_.s[end];
    return std::move(line_);
  }

 private:
  void add(const Point2d& point, double limit, const LanePoint& lane) {
    line_.points.push_back(point);
    line_.limits.push_back(limit);
    line_.lanes.push_back(lane);
  }

  const HdMap& map_;
  const double default_limit_;
  CourseLine line_;
};

}  // namespace

CourseLine courseLine(const HdMap& map, const RouteRow& row, double lead_in, double lead_out, double default_limit) {
  std::vector<LaneRange> pieces = row.pieces;
  joinEnds(map, &pieces);
  const LaneRange &first = pieces.front(), &last = pieces.back();
  LineBuilder builder(map, default_limit);
  if (lead_in > 0.0 && first.from_s > 0.0) {
    builder.add({first.lane, std::max(0.0, first.from_s - lead_in), first.from_s});
    builder.dropLast();  // the start, which comes again
  }
  const std::size_t begin = builder.size();
  for (const LaneRange& piece : pieces) builder.add(piece);
  builder.dropFolds(begin);
  const std::size_t end = builder.size() - 1;
  const double length = map.lane(last.lane).length();
  if (lead_out > 0.0 && last.to_s < length) builder.add({last.lane, last.to_s, std::min(last.to_s + lead_out, length)});
  return builder.take(begin, end);
}

}  // namespace external_command
