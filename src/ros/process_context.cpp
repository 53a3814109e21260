// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/process_context.h"

#include <malloc.h>
#include <ros/console.h>

#include "external_command/PlanningPad.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/diagnostics.h"
#include "external_command/ros/frame_id.h"
#include "external_command/ros/map_store.h"
#include "external_command/ros/parameter_check.h"
#include "external_command/ros/ros_folder.h"
#include "external_command/ros/status.h"
#include "external_command/ros/steady_time.h"
#include "external_command/routing/reference_paths.h"

namespace external_command {

namespace {

constexpr double kSilenceCheckPeriod = 0.5;  // [s]
constexpr double kMotionPeriod = 0.1;        // [s]
constexpr double kReadinessPeriod = 0.2;     // [s]
constexpr double kMemoryPeriod = 3.0;        // without a request, after which memory is given back [s]

std::shared_ptr<const Router> routerOf(const ContextParams& params) {
  if (params.map_file.empty()) return nullptr;
  return sharedRouter({params.map_file, params.map_origin, params.map, params.router}, params.map_cache_folder);
}

/// The context outlives the nodelet that made it, and that nodelet's callback queue.
ros::NodeHandle onGlobalQueue(ros::NodeHandle nh) {
  nh.setCallbackQueue(ros::getGlobalCallbackQueue());
  return nh;
}

MotionWatchParams readMotionWatchParams(const ParameterReader& reader) {
  MotionWatchParams params;
  std::string word = "both";
  reader.read("arrival", &word);
  const std::map<std::string, ArrivalSource> sources = {
      {"reported", ArrivalSource::kReported}, {"pose", ArrivalSource::kPose}, {"both", ArrivalSource::kBoth}};
  const auto source = sources.find(word);
  if (source == sources.end()) {
    throw InvalidParameter(
        text("parameter ", reader.nameOf("arrival"), " is '", word, "'; give reported, pose or both"));
  }
  params.arrival = source->second;
  reader.readWithin("arrival_silence", 0.0, 3600.0, &params.silence);
  const ParameterReader tolerance = reader.within("arrival_tolerance");
  tolerance.read("along", &params.tolerances.along);
  tolerance.read("across", &params.tolerances.across);
  tolerance.read("heading", &params.tolerances.heading);
  tolerance.read("rest", &params.tolerances.rest);
  tolerance.validate(params.tolerances);
  return params;
}

/// @return  empty for none.
std::string readMapCacheFolder(const ParameterReader& reader) {
  std::string folder;
  reader.read("map_cache_folder", &folder);
  return folder == "none" ? "" : rosFolder(folder, "external_command/maps");
}

/// The name of a tf2 frame, which is never empty; `*frame` holds the default.
void readFrame(const ParameterReader& reader, const std::string& key, std::string* frame) {
  std::string given = *frame;
  reader.read(key, &given);
  *frame = frameId(given);
  if (!frame->empty()) return;
  throw InvalidParameter(
      text("parameter ", reader.nameOf(key), " is '", given, "', no name of a frame; rostopic echo /tf shows them"));
}

void readFrames(const ParameterReader& reader, ContextParams* params) {
  readFrame(reader, "map_frame", &params->map_frame);
  readFrame(reader, "base_frame", &params->base_frame);
  if (params->map_frame != params->base_frame) return;
  throw InvalidParameter(text("parameters ", reader.nameOf("map_frame"), " and ", reader.nameOf("base_frame"),
                              " are both '", params->map_frame,
                              "'; the vehicle's pose is the transform from the one to the other"));
}

/// Where the vehicle is, where that is known.
std::optional<Point2d> placeOf(const VehiclePose& vehicle) {
  try {
    return vehicle.get().position();
  } catch (const NotReady&) {
    return std::nullopt;
  }
}

/// Tells programs that know the map file's coordinates what to subtract from them.
void publishOrigin(const ros::NodeHandle& parameters, const Router* router) {
  const Point2d origin = router ? router->map().origin() : Point2d::Zero();
  noteKnownParameter(parameters.resolveName("map_origin_resolved"));
  parameters.setParam("map_origin_resolved", std::vector<double>{origin.x(), origin.y()});
}

}  // namespace

ContextParams readContextParams(const ParameterReader& reader) {
  ContextParams params;
  reader.readPath("map_file", &params.map_file);
  params.map_origin = readMapOrigin(reader);
  params.map_cache_folder = readMapCacheFolder(reader);
  params.map = readMapParams(reader.within("map"));
  readFrames(reader, &params);
  reader.readWithin("max_pose_age", 0.01, 3600.0, &params.max_pose_age);
  reader.readWithin("max_future_stamp", 0.0, 3600.0, &params.max_future_stamp);
  reader.readWithin("planner_silence_timeout", 0.1, 86400.0, &params.planner_silence_timeout);
  reader.readWithin("max_start_shift", 0.0, 100.0, &params.max_start_shift);
  reader.readWithin("report_clock_skew", 0.0, 60.0, &params.reports.clock_skew);
  params.motion_watch = readMotionWatchParams(reader);
  params.reports.may_finish = params.motion_watch.arrival != ArrivalSource::kPose;
  reader.readWithin("planning_threads", 0, 256, &params.planning.threads);
  reader.readWithin("planning_queue", 0, 1000, &params.planning.waiting);
  params.requests = readRequestLimits(reader.within("requests"));
  reader.readName("output_command_status_name", &params.status_topic);
  reader.readName("progress_name", &params.progress_topic);
  reader.readWithin("progress_rate", 0.01, 100.0, &params.progress_rate);
  reader.readName("readiness_name", &params.readiness_topic);
  reader.read("planner_follows_path", &params.planner_follows_path);
  reader.readName("command_log_name", &params.log_topic);
  reader.readName("routing_response_name", &params.routing_response_topic);
  reader.readName("path_name", &params.path_topic);
  params.vehicle = readVehicleParams(reader.within("vehicle"));
  const ParameterReader routing = reader.within("routing");
  params.router = readRouterParams(routing);
  params.router.min_turning_radius = params.vehicle.min_turning_radius;
  params.lane_way = readLaneWayParams(routing);
  params.reference_path = readReferencePathParams(routing);
  params.path_bounds = readPathBounds(routing);
  params.limits = readDriveLimits(reader.within("limits"));
  params.display = readDisplayParams(reader);
  params.display.map_frame = params.map_frame;
  params.display.base_frame = params.base_frame;
  params.display.vehicle = params.vehicle;
  params.display.requests = params.requests;
  return params;
}

std::shared_ptr<ProcessContext> ProcessContext::acquire(const ros::NodeHandle& nh, const ros::NodeHandle& parameters) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<ProcessContext>> live;
  const std::lock_guard<std::mutex> lock(mutex);
  auto& known = live[nh.getNamespace()];
  auto context = known.lock();
  if (!context) known = context = std::make_shared<ProcessContext>(nh, parameters);
  return context;
}

ProcessContext::ProcessContext(const ros::NodeHandle& nh, const ros::NodeHandle& parameters)
    : params_(readContextParams(ParameterReader(parameters))),
      nh_(onGlobalQueue(nh)),
      log_writer_(LogWriter::acquire()),
      planning_pool_(PlanningPool::acquire(params_.planning)),
      router_(routerOf(params_)),
      reference_paths_(router_ ? ReferencePaths::acquire(router_->mapPtr(), params_.vehicle, params_.reference_path)
                               : nullptr),
      vehicle_pose_(params_.map_frame, params_.base_frame, params_.max_pose_age, params_.max_future_stamp),
      planning_pads_(configuredPads()),
      registry_(
          [this, publisher = advertise<CommandStatus>(params_.status_topic, false)](CommandSerial serial,
                                                                                    const CommandStatus& status) {
            publisher.publish(status);
            status_changes_(serial, status);
            // Not here: the gate calls the registry while it is held.
            if (hasEnded(status)) reports_.post([this, serial] { gate_.retire(serial); });
          },
          params_.reports),
      motion_watch_(params_.motion_watch, params_.vehicle, vehicle_pose_, gate_, registry_),
      progress_topic_(advertise<CommandStatus>(params_.progress_topic, false), gate_, registry_),
      readiness_topic_(advertise<Readiness>(params_.readiness_topic, true), conditions_),
      diagnostics_(makeDiagnostics(parameters)),
      display_(nh_, params_.display, router_ ? router_->mapPtr() : nullptr, [this] { return placeOf(vehicle_pose_); }),
      housekeeping_(ExecutorOptions{"the housekeeping executor"}),
      reports_(ExecutorOptions{"the executor of the vehicle's reports"}) {
  publishOrigin(parameters, router_.get());
  master_watch_->keepParameters(parameters.getNamespace());
  memory_timer_ = housekeeping_.every(kMemoryPeriod, [this] { giveBackMemory(); });
  readiness_timer_ = housekeeping_.every(kReadinessPeriod, [this] { readiness_topic_.update(); });
  diagnostics_timer_ = housekeeping_.every(diagnostics_->period(), [this] { diagnostics_->publish(); });
  silence_timer_ =
      reports_.every(kSilenceCheckPeriod, [this] { registry_.noteSilence(params_.planner_silence_timeout); });
  motion_timer_ = reports_.every(kMotionPeriod, [this] { motion_watch_.look(); });
  progress_timer_ = reports_.every(1.0 / params_.progress_rate, [this] { progress_topic_.publish(); });
}

std::vector<ros::Publisher> ProcessContext::configuredPads() {
  std::vector<std::string> topics = {"planning/pad"};
  ParameterReader(ros::NodeHandle(nh_, "action_command_processor")).readNames("output_command_name", &topics);
  std::vector<ros::Publisher> publishers;
  for (const std::string& topic : topics) publishers.push_back(advertise<PlanningPad>(topic, false));
  return publishers;
}

Cancellation ProcessContext::cancel(CommandSerial serial, const std::string& by) {
  Cancellation cancellation;
  const std::optional<CommandStatus> before = registry_.statusOf(serial);
  if (!before) {
    cancellation.status = makeStatus(0, CommandStatus::UNKNOWN, ErrorCode::kUnknownId, "the command was forgotten");
    return cancellation;
  }
  const std::int64_t id = before->command_id;
  const auto end = [&] {
    cancellation.was_running = registry_.update(
        {serial, makeStatus(id, CommandStatus::ERROR, ErrorCode::kCancelled, text("cancelled by ", by))});
    return cancellation.was_running;
  };
  gate_.cancel(serial, end, [&](const ros::Time& stamp) { planning_pads_.send(PlanningPad::CLEAR_PLANNING, stamp); });
  cancellation.status = registry_.statusOf(serial).value_or(*before);
  return cancellation;
}

Cancellation ProcessContext::cancelById(std::int64_t command_id, const std::string& by) {
  const std::optional<CommandSerial> serial = registry_.serialOf(command_id);
  if (!serial) return {false, registry_.find(command_id)};
  return cancel(*serial, by);
}

ProcessContext::~ProcessContext() = default;

void ProcessContext::takeReport(CommandStatus report, const std::string& processor) {
  last_report_ = steadyNow();
  report.message = statusMessage(report.message);
  if (registry_.report(report, processor)) return;
  logLater(LogLevel::kWarn, odd_reports_,
           text("a report about command ", report.command_id, " is ignored: its status is ",
                static_cast<int>(report.status), "; a planner reports RUNNING (1), FINISHED (2) or ERROR (3)"));
}

void ProcessContext::showSentLater() {
  housekeeping_.post([this] { showSent(); });
}

void ProcessContext::showSent() {
  while (const auto motion = gate_.unshown()) {
    const std::vector<PreparedMessage> messages =
        motion->topics ? motion->topics->view() : std::vector<PreparedMessage>();
    gate_.show(*motion, [&] {
      for (const PreparedMessage& message : messages) message.send();
    });
  }
}

void ProcessContext::showMotionAgain() {
  const auto motion = gate_.motion();
  if (motion) gate_.showAgain(motion->command.serial, motion_watch_.restOf(*motion));
}

void ProcessContext::giveBackMemory() {
  const ArrivalNumber arrival = gate_.arrive();
  const bool is_quiet = arrival == last_arrival_ + 1;
  last_arrival_ = arrival;
  if (is_quiet && has_memory_) malloc_trim(0);
  has_memory_ = !is_quiet;
}

std::string ProcessContext::mapWords() const {
  const HdMap& map = requireRouter().map();
  return text("the map ", params_.map_file, ": ", map.lanes().size(), " lanes, ", map.parkingSpaces().size(),
              " parking spaces, ", map.areas().size(), " areas");
}

const Router& ProcessContext::requireRouter() const {
  if (router_) return *router_;
  throw NotReady("no map is loaded; set ~map_file of the component and start it again");
}

const ReferencePaths& ProcessContext::requireReferencePaths() const {
  requireRouter();
  return *reference_paths_;
}

}  // namespace external_command
