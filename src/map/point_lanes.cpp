// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <string_view>
#include <unordered_map>

#include "lane_checks.h"

namespace external_command {

namespace {

constexpr double kPoint = 0.001;        // [m], as Polyline has it
constexpr double kHalfLength = 0.0006;  // [m]

bool isPoint(const std::vector<Point2d>& line) {
  return line.size() >= 2 && std::all_of(line.begin(), line.end(),
                                         [&](const Point2d& point) { return (point - line.front()).norm() < kPoint; });
}

class PointLanes {
 public:
  PointLanes(MapData* data, MapFaults* faults) : data_(*data), faults_(*faults) {
    for (LaneData& lane : data_.lanes) lane_by_id_.emplace(lane.id, &lane);
  }

  void stretch(LaneData* lane) {
    const Point2d middle = lane->center.front();
    const Point2d ahead = unitVector(headingThrough(*lane));
    lane->center = {middle - kHalfLength * ahead, middle + kHalfLength * ahead};
    lane->heights.resize(lane->heights.empty() ? 0 : 2);
    faults_.add(MapFault::kLaneWithoutLength, {lane->id}, {middle}, lane->id);
  }

 private:
  /// In which the lanes before it end, else in which those after it begin.
  double headingThrough(const LaneData& lane) const {
    for (const std::string& id : lane.predecessors) {
      const LaneData* before = find(id);
      if (before == nullptr) continue;
      const std::vector<Point2d>& line = before->center;
      const auto begin = std::find_if(line.rbegin(), line.rend(),
                                      [&](const Point2d& point) { return (line.back() - point).norm() >= kPoint; });
      if (begin != line.rend()) return headingOf(line.back() - *begin);
    }
    for (const std::string& id : lane.successors) {
      const LaneData* after = find(id);
      if (after == nullptr) continue;
      const std::vector<Point2d>& line = after->center;
      const auto end = std::find_if(line.begin(), line.end(),
                                    [&](const Point2d& point) { return (point - line.front()).norm() >= kPoint; });
      if (end != line.end()) return headingOf(*end - line.front());
    }
    return 0.0;
  }

  /// A lane that has a length.
  const LaneData* find(const std::string& id) const {
    const auto found = lane_by_id_.find(id);
    if (found == lane_by_id_.end()) return nullptr;
    const std::vector<Point2d>& line = found->second->center;
    const bool is_line = line.size() >= 2 && std::all_of(line.begin(), line.end(), isPlausible) && !isPoint(line);
    return is_line ? found->second : nullptr;
  }

  MapData& data_;
  MapFaults& faults_;
  std::unordered_map<std::string_view, const LaneData*> lane_by_id_;
};

}  // namespace

void stretchPointLanes(MapData* data, MapFaults* faults) {
  std::vector<LaneData*> points;
  for (LaneData& lane : data->lanes) {
    const bool is_usable = std::all_of(lane.center.begin(), lane.center.end(), isPlausible);
    const bool connects = !lane.predecessors.empty() || !lane.successors.empty();
    if (is_usable && connects && isPoint(lane.center)) points.push_back(&lane);
  }
  if (points.empty()) return;
  PointLanes lanes(data, faults);
  for (LaneData* lane : points) lanes.stretch(lane);
}

}  // namespace external_command
