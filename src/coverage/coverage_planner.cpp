// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_planner.h"

#include <chrono>
#include <cmath>

#include "connector.h"
#include "draft.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "field.h"
#include "grid.h"
#include "laps.h"
#include "order.h"
#include "swaths.h"

namespace external_command {

CoveragePlanner::CoveragePlanner(const VehicleParams& vehicle, const CoverageParams& params)
    : vehicle_(vehicle), params_(params) {
  vehicle.validate();
  params.validate();
}

CoverageResult CoveragePlanner::plan(const CoverageArea& area, const std::optional<Pose2d>& start,
                                     const CoverageProgress& progress, const CancelToken& cancel) const {
  (void)progress;
  const auto began = std::chrono::steady_clock::now();
  const Field field(vehicle_, params_, area, start, cancel);
  const double price = (getenv("PRICE") ? atof(getenv("PRICE")) : 4.0) / field.width();
  const std::vector<Draft> drafts = makeDrafts(field, price);
  if (getenv("V")) for (auto& d : drafts) fprintf(stderr, "laps %d cost %.1f works %zu\n", d.laps, d.cost, d.works.size());
  const std::vector<Work>& works = drafts.front().works;
  CoverageResult result;
  Curve path;
  std::vector<bool> tool;
  std::optional<Pose2d> at = field.start();
  const Connector connector(field);
  Routes routes(field);
  CoverageGrid done = field.makeGrid();
  for (const Step& step : orderOf(field, works, &routes)) {
    const Curve& way = works[step.work].ways[step.way];
    Path points;
    if (at) {
      const auto link = connector.connect(*at, way.start);
      if (!link) {
        result.warnings.push_back(text("no way from ", external_command::at(*at), " to ", external_command::at(way.start)));
        continue;
      }
      points = sampleArcs(link->start, link->arcs, params_.spacing);
      result.path.insert(result.path.end(), points.begin() + (result.path.empty() ? 0 : 1), points.end());
    }
    const std::size_t first = result.path.empty() ? 0 : result.path.size() - 1;
    points = sampleArcs(way.start, way.arcs, params_.spacing);
    for (ReferencePoint& point : points) point.tool_on = true;
    result.path.insert(result.path.end(), points.begin() + (result.path.empty() ? 0 : 1), points.end());
    Swath swath;
    swath.index = result.swaths.size();
    swath.first = first;
    swath.last = result.path.size() - 1;
    swath.length = way.length();
    swath.covered_area = done.sweep(way, field.width());
    result.swaths.push_back(swath);
    at = way.end();
  }
  result.reachable_area = done.area(kGoal, 0);
  result.coverage_ratio = done.area(kGoal | kSwept, 0) / done.area(kGoal, 0);
  for (ReferencePoint& point : result.path) point.x += field.origin().x(), point.y += field.origin().y();
  setArcLengths(&result.path);
  result.length = result.path.empty() ? 0.0 : result.path.back().s;
  result.planning_time = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return result;
}

}  // namespace external_command
