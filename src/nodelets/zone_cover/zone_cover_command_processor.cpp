// SPDX-License-Identifier: Apache-2.0
#include "zone_cover_command_processor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "external_command/ZoneCoverAction.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/map/near_ids.h"
#include "external_command/ros/action_front.h"
#include "external_command/routing/area_access.h"
#include "zone_entry.h"
#include "zone_resume.h"

namespace external_command {

namespace {

constexpr double kTrackingPeriod = 0.1;   // [s]
constexpr double kShortestBudget = 1e-3;  // that a plan is begun with [s]

void requireStartHeading(const ZoneCoverCommand& command) {
  if (command.way_point[0].has_heading) return;
  throw InvalidRequest("way_point[0].has_heading is false; the start of a zone needs a heading");
}

/// A vehicle that sweeps on while its plan is made must not come back for what it has swept meanwhile.
/// @throws InvalidRequest  nothing is left then.
CoverageProgress afterwards(CoverageProgress progress, const std::vector<Swath>& on_the_way) {
  for (const Swath& swath : on_the_way) progress.sweep(swath.index, swath.from + swath.length);
  if (!on_the_way.empty() && progress.countDone() == progress.lines.size()) {
    throw InvalidRequest("resume: the vehicle is about to sweep the last of this zone; let the running command end");
  }
  return progress;
}

}  // namespace

CoverageParams readCoverageParams(const ParameterReader& reader) {
  CoverageParams params;
  std::string objective = "shortest";
  double heading = std::nan("");
  reader.read("swath_width", &params.swath_width);
  reader.read("overlap", &params.overlap);
  reader.read("margin", &params.margin);
  reader.read("headland_laps", &params.headland_laps);
  reader.read("headland_first", &params.headland_first);
  reader.read("swath_heading", &heading);
  reader.read("objective", &objective);
  reader.read("target_coverage", &params.target_coverage);
  reader.read("max_gap", &params.max_gap);
  reader.read("gear_change_cost", &params.gear_change_cost);
  reader.read("reverse_to_turn", &params.reverse_to_turn);
  reader.read("turn_speed", &params.turn_speed);
  reader.read("path_spacing", &params.spacing);
  reader.read("time_budget", &params.time_budget);
  reader.readSize("max_grid_rows", 1, 10000000, &params.max_grid_rows);
  if (reader.has("swath_heading")) params.swath_heading = heading;
  if (objective != "shortest" && objective != "fewest_turns") {
    throw InvalidParameter(
        text("parameter ", reader.nameOf("objective"), " is '", objective, "'; give shortest or fewest_turns"));
  }
  params.objective = objective == "shortest" ? CoverageObjective::kShortest : CoverageObjective::kFewestTurns;
  reader.validate(params);
  return params;
}

ZoneCoverCommandProcessor::ZoneCoverCommandProcessor()
    : MotionCommandProcessor<ZoneCover>("external_command/zone_cover") {
  offerAction<ZoneCoverAction>();
}

ZoneCoverCommandProcessor::~ZoneCoverCommandProcessor() {
  stopServing();
  tracking_timer_.stop();
  tracking_executor_.stop();
}

void ZoneCoverCommandProcessor::start() {
  MotionCommandProcessor<ZoneCover>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  needsMap();
  needsPose();
  if (planner_->hasGrid()) needs("obstacle_grid", [this] { return planner_->gridWords(); });
  coverage_params_ = readCoverageParams(parameters().within("coverage"));
  parameters().readWithin("access_distance", 0.0, 100.0, &access_distance_);
  std::string folder;
  parameters().read("progress_folder", &folder);
  folder_ = zoneFolder(folder);
  removeLeftovers(folder_, getNodeHandle().getNamespace());
  keeper_.emplace();
}

void ZoneCoverCommandProcessor::open() {
  MotionCommandProcessor<ZoneCover>::open();
  tracking_timer_ = tracking_executor_.every(kTrackingPeriod, [this] { track(); });
}

void ZoneCoverCommandProcessor::check(const ZoneCoverCommand& command) const {
  const bool by_area = !command.zone_cover_area_id.empty();
  const bool by_polygon = !command.drivable_roi.points.empty();
  if (by_area && by_polygon) {
    throw InvalidRequest(text("zone_cover_area_id is ", quoted(command.zone_cover_area_id), ", and drivable_roi has ",
                              command.drivable_roi.points.size(), " points; give one of them, not both"));
  }
  if (!by_area && !by_polygon) {
    throw InvalidRequest(
        "zone_cover_area_id and drivable_roi are both empty; give the id of an area of the map, or a polygon");
  }
  checkWayPoints(command.way_point, command.is_start_pose_set, context().params().requests);
  requireSendable(command.way_point, "way_point");
  if (by_polygon && command.way_point.size() > (command.is_start_pose_set ? 1u : 0u)) {
    throw InvalidRequest("way_point needs lanes to drive on; with drivable_roi only a start can be given");
  }
  if (by_polygon && command.is_start_pose_set) requireStartHeading(command);
  if (by_polygon) checkPolygon(command.drivable_roi, "drivable_roi", context().params().requests);
  checkPolygons(command.non_drivable_roi, "non_drivable_roi", context().params().requests);
  paramsFor(command);
  requireTargetSpeed(command.target_speed);
  if (!command.skip_swath.empty() && !command.resume) {
    throw InvalidRequest("skip_swath needs resume: swaths are known of a zone that was begun");
  }
}

CoverageParams ZoneCoverCommandProcessor::paramsFor(const ZoneCoverCommand& command) const {
  CoverageParams params = coverage_params_;
  if (command.swath_width == 0.0) return params;
  params.swath_width = command.swath_width;
  try {
    params.validate();
  } catch (const InvalidParameter& error) {
    throw InvalidRequest(text("swath_width ", command.swath_width, " does not go with the parameters: ", error.what()));
  }
  return params;
}

const Area& ZoneCoverCommandProcessor::areaOf(const ZoneCoverCommand& command) const {
  const HdMap& map = context().requireRouter().map();
  const Area* area = map.findArea(command.zone_cover_area_id);
  if (area != nullptr) return *area;
  throw InvalidRequest(text("zone_cover_area_id ", quoted(command.zone_cover_area_id), " is none of the ",
                            map.areas().size(), " areas of the map", nearAreaIds(map, command.zone_cover_area_id)));
}

CoverageArea ZoneCoverCommandProcessor::zoneOf(const ZoneCoverCommand& command, const CancelToken& cancel) const {
  const Pose2d frame = context().vehiclePose().ofFrame(command.header.frame_id);
  const bool by_area = !command.zone_cover_area_id.empty();
  return {by_area ? areaOf(command).polygon : toPolygon(command.drivable_roi, frame, "drivable_roi"),
          toObstacles(command.non_drivable_roi, frame, cancel), planner_->grid(), planner_->regionLimits()};
}

Pose2d ZoneCoverCommandProcessor::givenStart(const ZoneCoverCommand& command, const PlanStart& start) const {
  if (!command.is_start_pose_set) return start.pose();
  return toMapPose(command.way_point[0], context().vehiclePose().ofFrame(command.header.frame_id));
}

bool ZoneCoverCommandProcessor::isInside(const ZoneCoverCommand& command, const PlanStart& start) const {
  const bool has_way = command.way_point.size() > (command.is_start_pose_set ? 1u : 0u);
  return !has_way && areaOf(command).polygon.contains(givenStart(command, start).position());
}

double ZoneCoverCommandProcessor::planningTime(const ZoneCoverCommand& command, const Pose2d& vehicle) const {
  const bool drives_lanes = !command.zone_cover_area_id.empty() && !isInside(command, PlanStart(vehicle));
  return drives_lanes ? 0.0 : coverage_params_.time_budget;
}

/// What is wrong with a polygon shows before that disturbs another command that is being planned.
std::optional<RoutingTask> ZoneCoverCommandProcessor::convert(const ZoneCoverCommand& command, const PlanStart& start) {
  zoneOf(command, {});
  givenStart(command, start);
  if (command.zone_cover_area_id.empty()) return std::nullopt;
  const Area& area = areaOf(command);
  if (isInside(command, start)) {
    if (command.is_start_pose_set) requireStartHeading(command);
    return std::nullopt;
  }
  RoutingTask task =
      beginRoutingTask(context(), start, command.header.frame_id, command.is_start_pose_set, command.way_point);
  setGoals(context().requireRouter().map(), accessPoints(context().requireRouter().map(), area, access_distance_),
           &task);
  return task;
}

void ZoneCoverCommandProcessor::enterZone(const ZoneCoverCommand& command, const CoverageArea& zone,
                                          const Deadline& whole, const CancelToken& cancel, MotionPlan* plan) const {
  const Deadline deadline = planner_->deadline().orSooner(whole);
  const HdMap& map = context().requireRouter().map();
  if (!command.is_start_pose_set) {
    leaveParkingPlace(context(), plan->start.pose(), *planner_, deadline.part(0.5), cancel, plan);
  }
  const Pose2d from = plan->path.back().pose();
  const auto entries = zoneEntries(zone, context().params().vehicle, coverage_params_.margin, from, cancel);
  Region::Parts parts = surfaceWith(map, zone.outer, from, cancel);
  parts.non_drivable.insert(parts.non_drivable.end(), zone.holes.begin(), zone.holes.end());
  const std::vector<std::optional<EndState>> onward(entries.size(), EndState());  // a sweep begins straight on
  leaveRouteFor(entries, onward, planner_->regionOf(std::move(parts)), *planner_, deadline, cancel, plan);
}

ZonePlanFile ZoneCoverCommandProcessor::fileOf(const ZoneCoverCommand& command, const CoverageArea& zone,
                                               const CoverageParams& params) const {
  const std::string& vehicle = getNodeHandle().getNamespace();
  return {folder_, zoneKey(vehicle, command.zone_cover_area_id, zone, params, context().params().vehicle)};
}

CoverageProgress ZoneCoverCommandProcessor::progressOf(const ZoneCoverCommand& command, const CoverageArea& zone,
                                                       const CoverageParams& params, const ZonePlanFile& file,
                                                       const CancelToken& cancel) {
  if (!command.resume) return {};
  track();  // so that the last moments of a run that is under way count too
  std::optional<CoverageProgress> kept = keeper_->unwritten(file.path());
  if (!kept) kept = readProgress(file, zone, params, context().params().vehicle, command.dry_run, cancel);
  const std::size_t total = kept->lines.size();
  if (kept->countDone() == total) {
    throw InvalidRequest(text("resume: the zone is swept, all ", total,
                              " swaths of it; send the command without resume to sweep it again"));
  }
  addSkipped(command.skip_swath, &*kept);
  return *std::move(kept);
}

std::vector<Swath> ZoneCoverCommandProcessor::sweptUntil(const PlanStart& start, const ZonePlanFile& file) {
  const std::lock_guard<std::mutex> lock(sweep_mutex_);
  if (!sweep_ || sweep_->is_over || sweep_->path != file.path()) return {};
  return sweep_->zone.swathsOn(start.approach());
}

void ZoneCoverCommandProcessor::appendCoverage(const CoverageResult& coverage, MotionPlan* plan) const {
  plan->path = join(plan->path, coverage.path, context().params().vehicle);
  PlanReport& report = plan->report;
  report.coverage_ratio = coverage.covered_free;
  report.reachable_coverage_ratio = coverage.coverage_ratio;
  report.warnings.insert(report.warnings.end(), coverage.warnings.begin(), coverage.warnings.end());
  if (!coverage.uncovered.empty()) {
    report.warnings.push_back(text(coverage.uncovered.size(), " parts stay unswept; ",
                                   std::lround(coverage.covered_area), " of ", std::lround(coverage.free_area),
                                   " m^2 are covered"));
  }
  plan->scene.conflicts = coverage.uncovered;
}

void ZoneCoverCommandProcessor::processSpecialCommand(const ZoneCoverCommand& command, const CancelToken& cancel,
                                                      MotionPlan* plan) {
  const CoverageArea zone = zoneOf(command, cancel);
  const CoverageParams params = paramsFor(command);
  const Deadline deadline(params.time_budget);
  const ZonePlanFile file = fileOf(command, zone, params);
  CoverageProgress progress = progressOf(command, zone, params, file, cancel);
  if (!plan->path.empty()) {
    plan->take_over();
    enterZone(command, zone, deadline, cancel, plan);
  }
  const Pose2d start = plan->path.empty() ? givenStart(command, plan->start) : plan->path.back().pose();
  CoverageParams timed = params;
  timed.time_budget = std::max(deadline.left(), kShortestBudget);
  const CoveragePlanner planner(context().params().vehicle, timed);
  std::vector<Swath> on_the_way;
  if (command.resume && beginsAtVehicle(command) && plan->path.empty()) on_the_way = sweptUntil(plan->start, file);
  CoverageResult coverage;
  try {
    coverage = planner.plan(zone, start, afterwards(progress, on_the_way), cancel, plan->take_over);
  } catch (const PlanningTimeout& error) {
    throw PlanningTimeout(timeoutWords(error.what(), timed.time_budget, params.time_budget, "coverage/time_budget"));
  }
  const std::size_t offset = plan->path.empty() ? 0 : plan->path.size() - 1;  // join() shares the point between both
  appendCoverage(coverage, plan);
  plan->scene.start = plan->path.front().pose();
  plan->scene.goal = plan->path.back().pose();
  plan->scene.regions.push_back(zone.outer.points());
  for (const Polygon& hole : zone.holes) plan->scene.obstacles.push_back(hole.points());
  plan->command.command_type = PlanningCommand::CUSTOM;
  plan->command.custom_command = packAny(command);
  if (command.dry_run) return;
  progress.lines = std::move(coverage.lines);
  ZoneTask task = taskOf(std::move(progress), coverage, offset);
  putInFront(std::move(on_the_way), plan->start.approach(), &task);
  auto planned =
      std::make_shared<PlannedSweep>(PlannedSweep{file.path(), std::move(task), command.resume != 0, nullptr});
  planned->draft = keeper_->draft(file, planned->task.progress);
  if (!planned->draft->failure().empty()) {
    plan->report.warnings.push_back(
        text("the progress of this sweep is not kept (~progress_folder): ", planned->draft->failure()));
  }
  plan->on_sent = [this, planned](const SentMotion& motion) { begin(planned.get(), motion); };
}

void ZoneCoverCommandProcessor::begin(PlannedSweep* planned, const SentMotion& motion) {
  const std::lock_guard<std::mutex> lock(sweep_mutex_);
  shiftPoints(motion.index_shift, &planned->task);
  Sweep next{motion.command, planned->path, ZoneSweep(std::move(planned->task), motion.path)};
  keeper_->adopt(*planned->draft);
  const bool goes_on = planned->resumes && sweep_ && sweep_->path == next.path;
  if (goes_on && next.zone.takeOver(sweep_->zone.progress())) keeper_->note(next.path, next.zone.progress(), true);
  if (sweep_ && !sweep_->is_over && sweep_->path != next.path) keeper_->finish(sweep_->path);
  sweep_.emplace(std::move(next));
}

void ZoneCoverCommandProcessor::track() {
  keeper_->tick();
  const std::lock_guard<std::mutex> lock(sweep_mutex_);
  if (!sweep_ || sweep_->is_over) return;
  const std::optional<CommandStatus> status = context().registry().statusOf(sweep_->command.serial);
  try {
    if (status && status->status == CommandStatus::FINISHED && sweep_->zone.finish()) {
      keeper_->note(sweep_->path, sweep_->zone.progress(), true);
    }
    if (status && status->status == CommandStatus::RUNNING) followVehicle();
  } catch (const Error& error) {
    logLater(LogLevel::kWarn, not_followed_, text(getName(), ": the progress is not followed: ", error.what()));
  }
  if (status && !hasEnded(*status)) return;
  keeper_->finish(sweep_->path);
  sweep_->is_over = true;
}

void ZoneCoverCommandProcessor::followVehicle() {
  const std::string before = sweep_->zone.words();
  const bool is_news = sweep_->zone.follow(context().vehiclePose().get());
  std::string words = sweep_->zone.words();
  if (is_news) keeper_->note(sweep_->path, sweep_->zone.progress(), words != before);
  const std::string failure = keeper_->failureOf(sweep_->path);
  if (!failure.empty()) words += "; the progress is not kept: " + failure;
  context().registry().update(
      {sweep_->command.serial, makeStatus(sweep_->command.id, CommandStatus::RUNNING, ErrorCode::kOk, words)});
}

}  // namespace external_command
