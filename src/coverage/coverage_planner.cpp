// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_planner.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "coverage/field/field.h"
#include "coverage/field/grid.h"
#include "coverage/field/uncovered.h"
#include "coverage/order/plan.h"
#include "coverage/path/connector.h"
#include "coverage/path/gradual_link.h"
#include "coverage/path/turns.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

using Clock = std::chrono::steady_clock;

/// How far before the place where a line was left it may be begun again, in turning radii.
constexpr std::array<double, 4> kBack = {0.0, 0.5, 1.0, 2.0};

constexpr double kOnLine = 5e-4;  ///< a vehicle that far from a line is on it [m], [rad]

bool isSame(const Pose2d& a, const Pose2d& b, double rounding = 1e-6) {
  return (a.position() - b.position()).norm() < rounding && std::abs(angleBetween(a.heading, b.heading)) < rounding;
}

/// The lines to be driven, in the field's frame, and the ways to them as planned.
struct Course {
  std::vector<Curve> lines;
  std::vector<int> laps;                    ///< of each line, as SwathLine::lap
  std::vector<std::optional<Curve>> links;  ///< to each line from the one before; none of an earlier run
};

Course courseOf(const Field& field, const CoverageProgress& progress) {
  Course course;
  for (const SwathLine& line : progress.lines) {
    const Pose2d start{line.start.x - field.origin().x(), line.start.y - field.origin().y(), line.start.heading};
    course.lines.push_back({start, line.arcs});
    course.laps.push_back(line.lap);
  }
  if (!course.lines.empty()) return course;
  Plan plan = bestPlan(field);
  for (const Step& step : plan.steps) {
    course.lines.push_back(plan.works[step.work].curveOf(step.way));
    course.laps.push_back(plan.works[step.work].lap);
  }
  course.links = std::move(plan.links);
  if (!course.lines.empty()) return course;
  throw NoPath("no swath fits into the area; is it too narrow for the vehicle to turn in?");
}

std::vector<SwathLine> linesOf(const Field& field, const Course& course) {
  std::vector<SwathLine> lines;
  for (std::size_t i = 0; i < course.lines.size(); ++i) {
    const Curve& line = course.lines[i];
    const Pose2d start{line.start.x + field.origin().x(), line.start.y + field.origin().y(), line.start.heading};
    lines.push_back({start, line.arcs, course.laps[i]});
  }
  return lines;
}

/// Drives the lines one after the other, and makes a path of that with what the statistics need.
class PathBuilder {
 public:
  PathBuilder(const Field& field, const Course& course, CoverageResult* result)
      : field_(field), course_(course), at_(field.start()), swept_(field.makeGrid()), result_(result) {}

  /// The first `length` [m] of swath `index` were swept by an earlier run.
  void count(std::size_t index, double length) {
    if (length <= 0.0) return;
    field_.poll();
    const Curve done = partOf(course_.lines[index], 0.0, length);
    sweep(sampleArcs(done.start, done.arcs, field_.params().spacing));
  }

  /// @param from  what lies before it on the line was swept by an earlier run [m].
  void drive(std::size_t index, double from) {
    field_.poll();
    std::vector<Approach> approaches = approachesOf(index, from);
    if (approaches.empty()) {
      result_->warnings.push_back(text("swath ", index, " is left out: the footprint would not stay inside"));
      return;
    }
    for (Approach& approach : approaches) {
      std::optional<Curve> link;
      if (at_ && !approach.is_here) {
        link = wayTo(index, approach.way);
        if (!link || !field_.isBarelyFree(*link)) continue;
      }
      at_ = approach.way.end();
      legs_.push_back({index, std::move(link), std::move(approach)});
      return;
    }
    result_->warnings.push_back(text("swath ", index, " is left out: no way leads there from ", at(*at_)));
  }

  /// @return  whether any line is driven.
  bool finish() {
    if (legs_.empty()) return false;
    makePath();
    Path& path = result_->path;
    for (ReferencePoint& point : path) {
      point.x += field_.origin().x();
      point.y += field_.origin().y();
      point.speed = field_.vehicle().max_speed;
    }
    setArcLengths(&path);
    limitSteering(field_.vehicle(), &path);
    result_->length = path.empty() ? 0.0 : path.back().s;
    result_->gear_changes = gearChanges(path);
    for (std::size_t i = 1; i < result_->swaths.size(); ++i) {
      result_->turns += result_->swaths[i].first > result_->swaths[i - 1].last;
    }
    measure();
    return true;
  }

 private:
  /// A place on a line to begin at, and the line from there on.
  struct Approach {
    double from = 0.0;  ///< [m]
    Curve way;
    double cost = 0.0;     ///< about what it takes to get there, and what is driven twice [m]
    bool is_here = false;  ///< the vehicle is there
  };

  /// A line that is driven, or the rest of one.
  struct Leg {
    std::size_t index;          ///< of the line
    std::optional<Curve> link;  ///< that leads there, where one is needed
    Approach approach;
  };

  /// The whole line; or where the rest of it may be begun, the cheapest first: a vehicle that stands beside the line
  /// by a little gets onto it sooner when it backs up.
  std::vector<Approach> approachesOf(std::size_t index, double swept) const {
    const Curve& line = course_.lines[index];
    std::vector<Approach> approaches;
    if (swept <= 0.0) {
      if (field_.isBarelyFree(line)) approaches.push_back({0.0, line, 0.0});
      return approaches;
    }
    if (const std::optional<double> here = placeOn(line, swept)) {
      approaches.push_back({*here, partOf(line, *here, line.length()), 0.0, true});
      if (field_.isBarelyFree(approaches.back().way)) return approaches;
      approaches.clear();
    }
    double last = -1.0;
    for (const double back : kBack) {
      const double from = std::max(0.0, swept - back * field_.radius());
      Approach approach{from, partOf(line, from, line.length()), swept - from};
      if (from == last || approach.way.arcs.empty() || !field_.isBarelyFree(approach.way)) break;
      if (at_) approach.cost += costOfWay(*at_, approach.way.start);
      approaches.push_back(std::move(approach));
      last = from;
    }
    std::stable_sort(approaches.begin(), approaches.end(),
                     [](const Approach& a, const Approach& b) { return a.cost < b.cost; });
    return approaches;
  }

  /// Where on the line the vehicle is, if that is where it was left, by some centimetres: one that is working on it
  /// just goes on, and needs no way to get there.
  std::optional<double> placeOn(const Curve& line, double swept) const {
    if (!at_) return std::nullopt;
    double place = swept;
    // On an arc, each step comes a good deal nearer.
    for (int i = 0; i < 3 && !isSame(poseAt(line, place), *at_); ++i) {
      const Pose2d pose = poseAt(line, place);
      place += unitVector(pose.heading).dot(at_->position() - pose.position());
    }
    const bool is_near = std::abs(place - swept) <= CoverageProgress::kLineEnd && place < line.length();
    return is_near && isSame(poseAt(line, place), *at_, kOnLine) ? std::optional(place) : std::nullopt;
  }

  /// As if nothing were in the way.
  double costOfWay(const Pose2d& from, const Pose2d& to) const {
    return turnsWithoutObstacles(from, to, field_.radius(), field_.gearPrice()).front().cost;
  }

  /// The path along all legs; links reach into the lines at both their ends.
  void makePath() {
    std::optional<GradualLink> link = linkTo(0);
    for (std::size_t i = 0; i < legs_.size(); ++i) {
      field_.poll();
      if (link) append(partOf(link->curve, link->before, link->curve.length() - link->after), false);
      std::optional<GradualLink> next = linkTo(i + 1);
      const Curve& line = legs_[i].approach.way;
      Swath swath = swathOf(legs_[i]);
      if (link) work(partOf(link->curve, link->curve.length() - link->after, link->curve.length()), &swath);
      work(partOf(line, link ? link->after : 0.0, line.length() - (next ? next->before : 0.0)), &swath);
      if (next) work(partOf(next->curve, 0.0, next->before), &swath);
      swath.last = result_->path.size() - 1;
      swath.covered_area = swath.covered.back();
      result_->working_length += swath.length;
      result_->swaths.push_back(std::move(swath));
      link = std::move(next);
    }
  }

  std::optional<GradualLink> linkTo(std::size_t leg) const {
    if (leg >= legs_.size() || !legs_[leg].link) return std::nullopt;
    const Curve* const before = leg > 0 ? &legs_[leg - 1].approach.way : nullptr;
    return gradualLink(field_, before, *legs_[leg].link, legs_[leg].approach.way);
  }

  Swath swathOf(const Leg& leg) const {
    Swath swath;
    swath.index = leg.index;
    swath.first = result_->path.empty() ? 0 : result_->path.size() - 1;
    swath.from = leg.approach.from;
    swath.length = leg.approach.way.length();
    swath.covered = {0.0};
    return swath;
  }

  void work(const Curve& part, Swath* swath) {
    const std::vector<double> covered = sweep(append(part, true));
    const double before = swath->covered.back();
    for (std::size_t i = 1; i < covered.size(); ++i) swath->covered.push_back(before + covered[i]);
  }

  /// As planned, if the vehicle is where the plan takes it to be.
  std::optional<Curve> wayTo(std::size_t index, const Curve& way) const {
    if (index < course_.links.size() && course_.links[index] && isSame(course_.links[index]->start, *at_)) {
      return course_.links[index];
    }
    const Curve* driven = legs_.empty() ? nullptr : &course_.lines[legs_.back().index];
    return Connector(field_).connect(driven, *at_, way);
  }

  /// @return  the points along `curve`.
  Path append(const Curve& curve, bool tool_on) {
    Path points = sampleArcs(curve.start, curve.arcs, field_.params().spacing);
    for (ReferencePoint& point : points) point.tool_on = tool_on;
    Path& path = result_->path;
    path.insert(path.end(), points.begin() + (path.empty() ? 0 : 1), points.end());
    return points;
  }

  /// Marks what work along `points` sweeps. @return  what it adds up to each of them [m^2].
  std::vector<double> sweep(const Path& points) {
    std::vector<double> covered{0.0};
    for (std::size_t i = 1; i < points.size(); ++i) {
      const double driven = points[i].s - points[i - 1].s;
      const double length = signOf(points[i].direction) * driven;
      const Curve piece{points[i - 1].pose(), {{length, points[i].kappa}}};
      covered.push_back(covered.back() + swept_.sweep(piece, field_.width()));
    }
    return covered;
  }

  void measure() {
    field_.cancel().throwIfCancelled();
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
  std::vector<Leg> legs_;
  CoverageGrid swept_;
  CoverageResult* result_;
};

/// What is still to be driven: the line in hand, those after it and those before it in their order, and those that
/// were skipped at the end.
std::vector<std::size_t> todoOf(const CoverageProgress& progress, std::size_t total) {
  std::vector<bool> skipped(total, false);
  for (const std::size_t index : progress.skipped) skipped[index] = true;
  std::size_t in_hand = progress.swept.size();
  while (in_hand > 0 && progress.swept[in_hand - 1] <= 0.0) --in_hand;
  if (in_hand > 0) --in_hand;
  std::vector<std::size_t> todo;
  for (const bool wanted : {false, true}) {
    for (std::size_t k = 0; k < total; ++k) {
      const std::size_t i = (in_hand + k) % total;
      const bool is_done = !progress.lines.empty() && progress.isDone(i);
      if (!is_done && skipped[i] == wanted) todo.push_back(i);
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
                                     const CoverageProgress& progress, const CancelToken& cancel,
                                     const std::function<void()>& checked) const {
  const auto began = Clock::now();
  requirePlausible(progress, area.outer, vehicle_, params_, cancel);
  const Field field(vehicle_, params_, area, start, cancel);
  if (checked) checked();
  const Course course = courseOf(field, progress);
  CoverageResult result;
  if (!field.startWarning().empty()) result.warnings.push_back(field.startWarning());
  result.lines = linesOf(field, course);
  PathBuilder builder(field, course, &result);
  for (std::size_t i = 0; i < progress.swept.size(); ++i) builder.count(i, progress.swept[i]);
  for (const std::size_t index : todoOf(progress, course.lines.size())) builder.drive(index, progress.sweptOf(index));
  if (!builder.finish()) {
    throw NoPath(text("no swath can be reached", start ? text(" from ", at(*start)) : std::string(), "; ",
                      result.warnings.empty() ? "all are done" : result.warnings.front()));
  }
  result.planning_time = std::chrono::duration<double>(Clock::now() - began).count();
  return result;
}

}  // namespace external_command
