// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "connector.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "field.h"
#include "grid.h"
#include "plan.h"
#include "uncovered.h"

namespace external_command {

namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

bool isSame(const Pose2d& a, const Pose2d& b) {
  constexpr double kRounding = 1e-6;
  return (a.position() - b.position()).norm() < kRounding && std::abs(angleBetween(a.heading, b.heading)) < kRounding;
}

/// Drives the steps of a plan one after the other and keeps what the path and the statistics need.
class PathBuilder {
 public:
  PathBuilder(const Field& field, const Plan& plan, const std::optional<Pose2d>& start, CoverageResult* result)
      : field_(field), plan_(plan), at_(start), swept_(field.makeGrid()), result_(result) {}

  /// Swath `index` was swept by an earlier run.
  void count(std::size_t index) { swept_.sweep(wayOf(index), field_.width()); }

  void drive(std::size_t index) {
    const Curve way = wayOf(index);
    if (!field_.isBarelyFree(way)) {
      result_->warnings.push_back(text("swath ", index, " is left out: the footprint would not stay inside"));
      return;
    }
    if (at_ && !transfer(way.start, index)) return;
    Swath swath;
    swath.index = index;
    swath.first = result_->path.empty() ? 0 : result_->path.size() - 1;
    append(way, true);
    swath.last = result_->path.size() - 1;
    swath.length = way.length();
    swath.covered_area = swept_.sweep(way, field_.width());
    result_->working_length += swath.length;
    result_->swaths.push_back(swath);
    at_ = way.end();
  }

  void finish() {
    Path& path = result_->path;
    for (ReferencePoint& point : path) {
      point.x += field_.origin().x();
      point.y += field_.origin().y();
      point.speed = field_.vehicle().max_speed;
    }
    setArcLengths(&path);
    limitSpeeds(field_.vehicle(), &path);
    result_->length = path.empty() ? 0.0 : path.back().s;
    result_->gear_changes = gearChanges(path);
    for (std::size_t i = 1; i < result_->swaths.size(); ++i) {
      result_->turns += result_->swaths[i].first > result_->swaths[i - 1].last;
    }
    measure();
  }

 private:
  Curve wayOf(std::size_t index) const {
    const Step& step = plan_.steps[index];
    return plan_.works[step.work].curveOf(step.way);
  }

  bool transfer(const Pose2d& to, std::size_t index) {
    const std::optional<Curve>& planned = plan_.links[index];
    const bool is_as_planned = planned && isSame(planned->start, *at_);
    const auto link = is_as_planned ? planned : Connector(field_).connect(*at_, to);
    if (link && field_.isBarelyFree(*link)) {
      append(*link, false);
      return true;
    }
    result_->warnings.push_back(text("swath ", index, " is left out: no way leads there from ", at(*at_)));
    return false;
  }

  void append(const Curve& curve, bool tool_on) {
    Path points = sampleArcs(curve.start, curve.arcs, field_.params().spacing);
    for (ReferencePoint& point : points) point.tool_on = tool_on;
    Path& path = result_->path;
    path.insert(path.end(), points.begin() + (path.empty() ? 0 : 1), points.end());
  }

  void measure() {
    CoverageResult& result = *result_;
    result.free_area = swept_.area(kFree, 0);
    result.reachable_area = swept_.area(kGoal, 0);
    result.covered_area = swept_.area(kFree | kSwept, 0);
    result.covered_free = result.covered_area / std::max(result.free_area, 1e-9);
    result.coverage_ratio = swept_.area(kGoal | kSwept, 0) / std::max(result.reachable_area, 1e-9);
    double new_area = 0.0;
    for (const Swath& swath : result.swaths) new_area += swath.covered_area;
    const double strips = result.working_length * field_.width();
    result.overlap = new_area > 0.0 ? std::max(0.0, strips / new_area - 1.0) : 0.0;
    result.uncovered = uncoveredParts(swept_, field_.origin());
  }

  const Field& field_;
  const Plan& plan_;
  std::optional<Pose2d> at_;
  CoverageGrid swept_;
  CoverageResult* result_;
};

void requireKnownSwaths(const CoverageProgress& progress, std::size_t total) {
  const auto require = [&](std::size_t index, const char* name) {
    if (index < total) return;
    throw InvalidRequest(text(name, " ", index, " is not in the plan; its swaths are 0 to ", total - 1));
  };
  require(progress.first_swath, "first swath");
  for (const std::size_t index : progress.skipped) require(index, "skipped swath");
}

std::optional<Pose2d> localPose(const std::optional<Pose2d>& pose, const Point2d& origin) {
  if (!pose) return std::nullopt;
  return Pose2d{pose->x - origin.x(), pose->y - origin.y(), pose->heading};
}

}  // namespace

CoveragePlanner::CoveragePlanner(const VehicleParams& vehicle, const CoverageParams& params)
    : vehicle_(vehicle), params_(params) {
  vehicle.validate();
  params.validate();
}

CoverageResult CoveragePlanner::plan(const CoverageArea& area, const std::optional<Pose2d>& start,
                                     const CoverageProgress& progress, const CancelToken& cancel) const {
  const auto began = Clock::now();
  const Field field(vehicle_, params_, area, progress.planned_from ? progress.planned_from : start, cancel);
  const Plan plan = bestPlan(field);
  const std::size_t swaths = plan.steps.size();
  if (swaths == 0) {
    throw NoPath("no swath fits into the area; is it too narrow for the vehicle to turn in?");
  }
  requireKnownSwaths(progress, swaths);

  CoverageResult result;
  result.total_swaths = swaths;
  PathBuilder builder(field, plan, localPose(start, field.origin()), &result);
  const auto is_skipped = [&](std::size_t index) {
    return std::find(progress.skipped.begin(), progress.skipped.end(), index) != progress.skipped.end();
  };
  for (std::size_t i = 0; i < swaths; ++i) {
    if (i < progress.first_swath && !is_skipped(i)) builder.count(i);
  }
  const auto drive = [&](std::size_t index) {
    cancel.throwIfCancelled();
    if (secondsSince(began) > params_.time_budget) {
      throw PlanningTimeout(text("the area was not planned within ", params_.time_budget, " s (time_budget)"));
    }
    builder.drive(index);
  };
  for (std::size_t i = progress.first_swath; i < swaths; ++i) {
    if (!is_skipped(i)) drive(i);
  }
  for (const std::size_t index : progress.skipped) drive(index);
  if (result.swaths.empty()) {
    throw NoPath(text("no swath can be reached", start ? text(" from ", at(*start)) : std::string(), "; ",
                      result.warnings.empty() ? "" : result.warnings.front()));
  }
  builder.finish();
  result.planning_time = secondsSince(began);
  return result;
}

}  // namespace external_command
