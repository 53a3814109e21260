// SPDX-License-Identifier: Apache-2.0
#include "zone_cover_command_processor.h"

#include <algorithm>
#include <utility>

#include "area_access.h"
#include "external_command/core/text.h"
#include "zone_entry.h"

namespace external_command {

namespace {

constexpr double kTrackingPeriod = 0.2;  // [s]

bool contains(const std::vector<std::size_t>& indices, std::size_t index) {
  return std::find(indices.begin(), indices.end(), index) != indices.end();
}

/// With the point indices of a path that `shift` points were put in front of; the vehicle may have driven some already.
std::vector<Swath> shifted(std::vector<Swath> swaths, std::ptrdiff_t shift) {
  const auto moved = [&](std::size_t index) {
    return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, static_cast<std::ptrdiff_t>(index) + shift));
  };
  for (Swath& swath : swaths) {
    swath.first = moved(swath.first);
    swath.last = moved(swath.last);
  }
  return swaths;
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
  reader.read("gear_change_cost", &params.gear_change_cost);
  reader.read("path_spacing", &params.spacing);
  reader.read("time_budget", &params.time_budget);
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
    : MotionCommandProcessor<ZoneCover>("external_command/zone_cover") {}

ZoneCoverCommandProcessor::~ZoneCoverCommandProcessor() {
  stopServing();
  tracking_timer_.stop();
  tracking_lane_.stop();
}

void ZoneCoverCommandProcessor::start() {
  MotionCommandProcessor<ZoneCover>::start();
  planner_.emplace(getNodeHandle(), parameters(), context());
  coverage_params_ = readCoverageParams(parameters().within("coverage"));
  parameters().readWithin("access_distance", 0.0, 100.0, &access_distance_);
  parameters().read("progress_folder", &progress_folder_);
}

void ZoneCoverCommandProcessor::open() {
  MotionCommandProcessor<ZoneCover>::open();
  ros::SteadyTimerOptions options;
  options.period = ros::WallDuration(kTrackingPeriod);
  options.callback = [this](const ros::SteadyTimerEvent&) { track(); };
  options.callback_queue = tracking_lane_.queue();
  tracking_timer_ = getNodeHandle().createSteadyTimer(options);
}

void ZoneCoverCommandProcessor::check(const ZoneCoverCommand& command) const {
  const bool by_area = !command.zone_cover_area_id.empty();
  const bool by_polygon = !command.drivable_roi.points.empty();
  if (by_area == by_polygon) {
    throw InvalidRequest("give either zone_cover_area_id, an area of the map, or drivable_roi, a polygon");
  }
  checkWayPoints(command.way_point, command.is_start_pose_set);
  if (by_polygon && command.way_point.size() > (command.is_start_pose_set ? 1u : 0u)) {
    throw InvalidRequest("way_point needs lanes to drive on; with drivable_roi only a start can be given");
  }
  if (by_polygon && command.is_start_pose_set && !command.way_point[0].has_heading) {
    throw InvalidRequest("way_point[0].has_heading is false; the start of a zone needs a heading");
  }
  if (by_polygon) checkPolygons({command.drivable_roi}, "drivable_roi");
  checkPolygons(command.non_drivable_roi, "non_drivable_roi");
  paramsFor(command);
  requireNotNegative(command.target_speed, "target_speed");
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
  throw InvalidRequest(text("zone_cover_area_id '", command.zone_cover_area_id, "' is none of the ", map.areas().size(),
                            " areas of the map"));
}

CoverageArea ZoneCoverCommandProcessor::zoneOf(const ZoneCoverCommand& command) const {
  const Pose2d frame = context().vehiclePose().ofFrame(command.header.frame_id);
  const bool by_area = !command.zone_cover_area_id.empty();
  CoverageArea zone{by_area ? areaOf(command).polygon : toPolygon(command.drivable_roi, frame, "drivable_roi"), {}};
  for (std::size_t i = 0; i < command.non_drivable_roi.size(); ++i) {
    zone.holes.push_back(toPolygon(command.non_drivable_roi[i], frame, text("non_drivable_roi[", i, "]")));
  }
  zone.grid = planner_->grid();
  return zone;
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

std::optional<RoutingTask> ZoneCoverCommandProcessor::convert(const ZoneCoverCommand& command, const PlanStart& start) {
  if (command.zone_cover_area_id.empty()) return std::nullopt;
  const Area& area = areaOf(command);
  if (isInside(command, start)) return std::nullopt;
  RoutingTask task =
      beginRoutingTask(context(), start, command.header.frame_id, command.is_start_pose_set, command.way_point);
  setGoals(context().requireRouter().map(), accessPoints(context().requireRouter().map(), area, access_distance_),
           &task);
  return task;
}

void ZoneCoverCommandProcessor::enterZone(const ZoneCoverCommand& command, const CoverageArea& zone,
                                          const CancelToken& cancel, MotionPlan* plan) const {
  const HdMap& map = context().requireRouter().map();
  if (!command.is_start_pose_set) {
    leaveParkingPlace(context(), plan->start.pose(), *planner_, cancel, plan);
  }
  const Pose2d from = plan->path.back().pose();
  const auto entries = zoneEntries(zone, context().params().vehicle, coverage_params_.margin, from);
  Region::Parts parts = surfaceWith(map, zone.outer, from);
  parts.non_drivable.insert(parts.non_drivable.end(), zone.holes.begin(), zone.holes.end());
  leaveRouteFor(entries, planner_->regionOf(std::move(parts)), *planner_, cancel, plan);
}

CoverageProgress ZoneCoverCommandProcessor::progressOf(const ZoneCoverCommand& command, const ZonePlanFile& file) {
  if (!command.resume) return {};
  std::optional<CoverageProgress> kept = file.read();
  if (!kept) {
    throw InvalidRequest(
        text("resume: no earlier run of this zone is known (", file.path(), "); send the command without resume"));
  }
  if (kept->done.size() == kept->lines.size()) {
    throw InvalidRequest(text("resume: the zone is swept, all ", kept->lines.size(),
                              " swaths of it; send the command without resume to sweep it again"));
  }
  for (const std::size_t index : command.skip_swath) {
    if (index >= kept->lines.size()) {
      throw InvalidRequest(
          text("skip_swath ", index, " is not in the plan; its swaths are 0 to ", kept->lines.size() - 1));
    }
    if (!contains(kept->done, index) && !contains(kept->skipped, index)) kept->skipped.push_back(index);
  }
  return *kept;
}

void ZoneCoverCommandProcessor::appendCoverage(const CoverageResult& coverage, MotionPlan* plan) const {
  plan->path = join(plan->path, coverage.path);
  PlanReport& report = plan->report;
  report.coverage_ratio = coverage.coverage_ratio;
  report.warnings.insert(report.warnings.end(), coverage.warnings.begin(), coverage.warnings.end());
  if (!coverage.uncovered.empty()) {
    report.warnings.push_back(text(coverage.uncovered.size(), " parts stay unswept; ", coverage.covered_area, " of ",
                                   coverage.free_area, " m^2 are covered"));
  }
  plan->scene.conflicts = coverage.uncovered;
}

void ZoneCoverCommandProcessor::processSpecialCommand(const ZoneCoverCommand& command, const CancelToken& cancel,
                                                      MotionPlan* plan) {
  const CoverageArea zone = zoneOf(command);
  const CoverageParams params = paramsFor(command);
  const CoveragePlanner planner(context().params().vehicle, params);
  if (!plan->path.empty()) enterZone(command, zone, cancel, plan);
  const Pose2d start = plan->path.empty() ? givenStart(command, plan->start) : plan->path.back().pose();

  track();  // so that the file tells of an earlier run's last moments too
  ZonePlanFile file(progress_folder_, zoneKey(zone, params, context().params().vehicle));
  CoverageProgress progress = progressOf(command, file);
  CoverageResult coverage = planner.plan(zone, start, progress, cancel);
  const std::size_t offset = plan->path.empty() ? 0 : plan->path.size() - 1;  // join() shares the point between both
  appendCoverage(coverage, plan);
  plan->scene.start = plan->path.front().pose();
  plan->scene.goal = plan->path.back().pose();
  plan->scene.regions.push_back(zone.outer.points());
  for (const Polygon& hole : zone.holes) plan->scene.obstacles.push_back(hole.points());
  plan->command.command_type = PlanningCommand::CUSTOM;
  plan->command.custom_command = packAny(command);
  if (command.dry_run) return;

  double todo = 0.0;
  for (Swath& swath : coverage.swaths) {
    swath.first += offset;
    swath.last += offset;
    todo += swath.covered_area;
  }
  progress.lines = std::move(coverage.lines);
  const double covered_before = std::max(0.0, coverage.covered_area - todo);
  plan->on_sent = [=, swaths = coverage.swaths, goal_area = coverage.reachable_area](const SentMotion& motion) {
    file.write(progress);
    const std::lock_guard<std::mutex> lock(sweep_mutex_);
    sweep_.emplace(Sweep{motion.command, ZoneTracker(*motion.path, shifted(swaths, motion.index_shift)), file, progress,
                         covered_before, goal_area});
  };
}

void ZoneCoverCommandProcessor::track() {
  const std::lock_guard<std::mutex> lock(sweep_mutex_);
  if (!sweep_) return;
  const std::optional<CommandStatus> known = context().registry().statusOf(sweep_->command.serial);
  if (!known) return sweep_.reset();
  const CommandStatus& status = *known;
  try {
    if (status.status == CommandStatus::FINISHED) keepDone(sweep_->tracker.swaths().size());
    if (status.status == CommandStatus::RUNNING) followVehicle();
  } catch (const Error& error) {
    ROS_WARN_STREAM_THROTTLE(10.0, getName() << ": the progress is not followed: " << error.what());
  }
  if (hasEnded(status)) sweep_.reset();
}

void ZoneCoverCommandProcessor::followVehicle() {
  ZoneTracker& tracker = sweep_->tracker;
  tracker.update(context().vehiclePose().get());
  keepDone(tracker.current());
  const double covered = sweep_->covered_before + tracker.coveredArea();
  const std::size_t total = sweep_->progress.lines.size();
  context().registry().update(
      {sweep_->command.serial,
       makeStatus(
           sweep_->command.id, CommandStatus::RUNNING, ErrorCode::kOk,
           text("swath ", std::min(sweep_->progress.done.size() + 1, total), " of ", total, ", ",
                static_cast<int>(100.0 * std::min(covered / std::max(sweep_->goal_area, 1e-9), 1.0)), " % covered"))});
}

/// The first `count` swaths of the path are swept.
void ZoneCoverCommandProcessor::keepDone(std::size_t count) {
  CoverageProgress& progress = sweep_->progress;
  const std::size_t before = progress.done.size();
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = sweep_->tracker.swaths()[i].index;
    if (contains(progress.done, index)) continue;
    progress.done.push_back(index);
    progress.skipped.erase(std::remove(progress.skipped.begin(), progress.skipped.end(), index),
                           progress.skipped.end());
  }
  if (progress.done.size() > before) sweep_->file.write(progress);
}

}  // namespace external_command
