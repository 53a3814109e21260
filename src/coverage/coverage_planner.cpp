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

bool isSame(const Pose2d& a, const Pose2d& b) {
  constexpr double kRounding = 1e-6;
  return (a.position() - b.position()).norm() < kRounding && std::abs(angleBetween(a.heading, b.heading)) < kRounding;
}

/// The lines to be driven, and the ways to them as planned.
struct Course {
  std::vector<Curve> lines;
  std::vector<std::optional<Curve>> links;  ///< to each line from the one before; none of an earlier run
};

Course courseOf(const Field& field, const CoverageProgress& progress) {
  Course course;
  for (const SwathLine& line : progress.lines) {
    const Pose2d start{line.start.x - field.origin().x(), line.start.y - field.origin().y(), line.start.heading};
    course.lines.push_back({start, line.arcs});
  }
  if (!course.lines.empty()) return course;
  Plan plan = bestPlan(field);
  for (const Step& step : plan.steps) course.lines.push_back(plan.works[step.work].curveOf(step.way));
  course.links = std::move(plan.links);
  if (!course.lines.empty()) return course;
  throw NoPath("no swath fits into the area; is it too narrow for the vehicle to turn in?");
}

std::vector<SwathLine> linesOf(const Field& field, const Course& course) {
  std::vector<SwathLine> lines;
  for (const Curve& line : course.lines) {
    const Pose2d start{line.start.x + field.origin().x(), line.start.y + field.origin().y(), line.start.heading};
    lines.push_back({start, line.arcs});
  }
  return lines;
}

/// Drives the steps of a plan one after the other and keeps what the path and the statistics need.
class PathBuilder {
 public:
  PathBuilder(const Field& field, const Course& course, CoverageResult* result)
      : field_(field), course_(course), at_(field.start()), swept_(field.makeGrid()), result_(result) {}

  /// Swath `index` was swept by an earlier run.
  void count(std::size_t index) { swept_.sweep(course_.lines[index], field_.width()); }

  void drive(std::size_t index) {
    field_.poll();
    const Curve& way = course_.lines[index];
    if (!field_.isBarelyFree(way)) {
      result_->warnings.push_back(text("swath ", index, " is left out: the footprint would not stay inside"));
      return;
    }
    if (at_ && !transfer(index)) return;
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
  bool transfer(std::size_t index) {
    const std::optional<Curve> link = wayTo(index);
    if (link && field_.isBarelyFree(*link)) {
      append(*link, false);
      return true;
    }
    result_->warnings.push_back(text("swath ", index, " is left out: no way leads there from ", at(*at_)));
    return false;
  }

  /// As planned, if the vehicle is where the plan takes it to be.
  std::optional<Curve> wayTo(std::size_t index) const {
    if (index < course_.links.size() && course_.links[index] && isSame(course_.links[index]->start, *at_)) {
      return course_.links[index];
    }
    const Curve* driven = result_->swaths.empty() ? nullptr : &course_.lines[result_->swaths.back().index];
    return Connector(field_).connect(driven, *at_, course_.lines[index]);
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
  const Course& course_;
  std::optional<Pose2d> at_;
  CoverageGrid swept_;
  CoverageResult* result_;
};

/// What is still to be driven: the lines in their order, those that were skipped at the end.
std::vector<std::size_t> todoOf(const CoverageProgress& progress, std::size_t total) {
  enum class State { kTodo, kDone, kSkipped };
  std::vector<State> states(total, State::kTodo);
  const auto mark = [&](const std::vector<std::size_t>& indices, State state, const char* name) {
    for (const std::size_t index : indices) {
      if (index >= total) {
        throw InvalidRequest(text(name, " swath ", index, " is not in the plan; its swaths are 0 to ", total - 1));
      }
      states[index] = state;
    }
  };
  mark(progress.done, State::kDone, "done");
  mark(progress.skipped, State::kSkipped, "skipped");
  std::vector<std::size_t> todo;
  for (const State wanted : {State::kTodo, State::kSkipped}) {
    for (std::size_t i = 0; i < total; ++i) {
      if (states[i] == wanted) todo.push_back(i);
    }
  }
  return todo;
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
  const Field field(vehicle_, params_, area, start, cancel);
  const Course course = courseOf(field, progress);
  const std::vector<std::size_t> todo = todoOf(progress, course.lines.size());
  CoverageResult result;
  result.lines = linesOf(field, course);
  PathBuilder builder(field, course, &result);
  for (std::size_t i = 0; i < course.lines.size(); ++i) {
    if (std::find(todo.begin(), todo.end(), i) == todo.end()) builder.count(i);
  }
  for (const std::size_t index : todo) builder.drive(index);
  if (result.swaths.empty()) {
    throw NoPath(text("no swath can be reached", start ? text(" from ", at(*start)) : std::string(), "; ",
                      result.warnings.empty() ? "all are done" : result.warnings.front()));
  }
  builder.finish();
  result.planning_time = std::chrono::duration<double>(Clock::now() - began).count();
  return result;
}

}  // namespace external_command
