// SPDX-License-Identifier: Apache-2.0
#include "lane_cleaning.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "external_command/core/text.h"
#include "lane_heights.h"

namespace external_command {

namespace {

/// The first point that lies farther than `longest` [m] from the one before it.
const Point2d* findLeap(const std::vector<Point2d>& points, double longest) {
  const auto is_leap = [longest](const Point2d& a, const Point2d& b) { return (b - a).norm() > longest; };
  const auto found = std::adjacent_find(points.begin(), points.end(), is_leap);
  return found == points.end() ? nullptr : &*std::next(found);
}

const Point2d* findImplausible(const std::vector<Point2d>& points) {
  const auto found = std::find_if_not(points.begin(), points.end(), isPlausible);
  return found == points.end() ? nullptr : &*found;
}

/// Where a fault of a lane as a whole is told to lie.
FaultPlace beginOf(const LaneData& lane) {
  const bool has_place = !lane.center.empty() && isPlausible(lane.center.front());
  return {has_place ? std::optional<Point2d>(lane.center.front()) : std::nullopt};
}

constexpr double kWidest = 1e4;  ///< half of a lane [m]

bool isUsable(double value) { return std::isfinite(value) && value >= 0.0; }

void cleanBoundary(const LaneData& lane, const char* side, LaneBoundary* boundary, MapFaults* faults) {
  if (const Point2d* point = findImplausible(boundary->points)) {
    faults->add(MapFault::kBoundaryUnusable, {lane.id}, beginOf(lane), lane.id, ": point ",
                point - boundary->points.data(), " of the ", side, " one is ", at(*point));
    boundary->points.clear();
  }
  const auto byS = [](const BoundaryTypeChange& a, const BoundaryTypeChange& b) { return a.s < b.s; };
  std::vector<BoundaryTypeChange>& types = boundary->types;
  types.erase(std::remove_if(types.begin(), types.end(), [](const auto& type) { return !isUsable(type.s); }),
              types.end());
  if (!std::is_sorted(types.begin(), types.end(), byS)) std::stable_sort(types.begin(), types.end(), byS);
}

void cleanWidths(const LaneData& lane, std::vector<WidthSample>* samples, MapFaults* faults) {
  const auto is_bad = [](const WidthSample& sample) {
    return !isUsable(sample.s) || !isUsable(sample.width) || sample.width > kWidest;
  };
  const auto bad = std::remove_if(samples->begin(), samples->end(), is_bad);
  for (auto sample = bad; sample != samples->end(); ++sample) {
    faults->add(MapFault::kWidthSampleUnusable, {lane.id}, beginOf(lane), lane.id);
  }
  samples->erase(bad, samples->end());
  const auto byS = [](const WidthSample& a, const WidthSample& b) { return a.s < b.s; };
  if (!std::is_sorted(samples->begin(), samples->end(), byS)) std::stable_sort(samples->begin(), samples->end(), byS);
}

/// @return false where the lane cannot be used at all.
bool clean(const MapParams& params, LaneData* lane, MapFaults* faults) {
  if (lane->id.empty()) {
    faults->add(MapFault::kLaneUnusable, {}, beginOf(*lane), "a lane without an id");
    return false;
  }
  if (const Point2d* point = findImplausible(lane->center)) {
    faults->add(MapFault::kLaneUnusable, {lane->id}, beginOf(*lane), lane->id, ": point ", point - lane->center.data(),
                " of the centre line is ", at(*point));
    return false;
  }
  if (const Point2d* point = findLeap(lane->center, params.max_segment_length)) {
    faults->add(MapFault::kLaneUnusable, {lane->id}, {*std::prev(point)}, lane->id, ": point ",
                point - lane->center.data(), " of the centre line, ", at(*point), ", lies ",
                metres((*point - *std::prev(point)).norm()), " from the one before it; the limit is ",
                metres(params.max_segment_length), " (~map/max_segment_length)");
    return false;
  }
  cleanBoundary(*lane, "left", &lane->left, faults);
  cleanBoundary(*lane, "right", &lane->right, faults);
  cleanWidths(*lane, &lane->left_widths, faults);
  cleanWidths(*lane, &lane->right_widths, faults);
  if (!isUsable(lane->speed_limit)) {
    faults->add(MapFault::kSpeedLimitUnusable, {lane->id}, beginOf(*lane), lane->id, ": ", lane->speed_limit);
    lane->speed_limit = 0.0;
  }
  return true;
}

}  // namespace

bool hasHeights(const LaneData& lane) {
  return std::any_of(lane.heights.begin(), lane.heights.end(), [](float z) { return z != 0.0F; });
}

std::optional<LaneShape> cleanLane(const MapParams& params, bool has_heights, LaneData* lane, MapFaults* faults) {
  if (!clean(params, lane, faults)) return std::nullopt;
  const FaultPlace begin = beginOf(*lane);
  try {
    std::vector<HeightSample> heights;
    if (has_heights) heights = heightProfile(lane->center, lane->heights);
    return LaneShape{Polyline(std::move(lane->center)), std::move(heights)};
  } catch (const std::invalid_argument& error) {
    faults->add(MapFault::kLaneUnusable, {lane->id}, begin, lane->id, ": the centre line has ", error.what());
    return std::nullopt;
  }
}

}  // namespace external_command
