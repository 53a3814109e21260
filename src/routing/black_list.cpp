// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/black_list.h"

#include <algorithm>

#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/map/near_ids.h"

namespace external_command {

namespace {

constexpr double kRounding = 1e-3;  // of an s that a program has computed [m]

LaneRange rangeOf(const HdMap& map, const BlackListedLane& part, const std::string& name) {
  const auto lane = map.findLane(part.id);
  if (!lane)
    throw InvalidRequest(
        text(name, " names lane ", quoted(part.id), ", which the map does not have", nearLaneIds(map, part.id)));
  const double length = map.lane(*lane).length();
  if (part.start_s == 0.0 && part.end_s == 0.0) return {*lane, 0.0, length};
  if (!(part.start_s < part.end_s && part.start_s <= length && part.start_s >= -kRounding)) {  // catches NaN
    throw InvalidRequest(text(name, " goes from s ", part.start_s, " to ", part.end_s, " m; lane ", part.id,
                              " goes from 0 to ", length,
                              " m: give a start_s on it, and an end_s beyond that (both 0: the whole lane)"));
  }
  // Maps may state another length than the centre line has, and callers take the end of the lane from that.
  return {*lane, std::max(part.start_s, 0.0), std::min(part.end_s, length)};
}

/// In both directions where the lane has both.
void add(const HdMap& map, const LaneRange& range, std::vector<LaneRange>* ranges) {
  ranges->push_back(range);
  const Lane& lane = map.lane(range.lane);
  if (lane.reverse) ranges->push_back({*lane.reverse, lane.length() - range.to_s, lane.length() - range.from_s});
}

}  // namespace

std::vector<LaneRange> blackList(const HdMap& map, const std::vector<BlackListedLane>& lanes,
                                 const std::vector<std::string>& roads) {
  std::vector<LaneRange> ranges;
  for (std::size_t i = 0; i < lanes.size(); ++i) {
    add(map, rangeOf(map, lanes[i], text("blacklisted_lane[", i, "]")), &ranges);
  }
  for (std::size_t i = 0; i < roads.size(); ++i) {
    if (!map.hasRoad(roads[i])) {
      throw InvalidRequest(text("blacklisted_road[", i, "] names road ", quoted(roads[i]),
                                ", which the map does not have", nearRoadIds(map, roads[i])));
    }
    for (const LaneIndex lane : map.lanesOfRoad(roads[i])) add(map, {lane, 0.0, map.lane(lane).length()}, &ranges);
  }
  return ranges;
}

}  // namespace external_command
