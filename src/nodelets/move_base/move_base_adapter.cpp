// SPDX-License-Identifier: Apache-2.0
#include "move_base_adapter.h"

#include <tf2/LinearMath/Quaternion.h>
#include <tf2/utils.h>

#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/bounded_service.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/request_arrival.h"
#include "external_command/ros/status.h"
#include "goal_plan_search.h"

namespace external_command {

namespace {

constexpr double kUpright = 0.999;  // of the vertical axis, after the rotation
constexpr const char* kNewer = "a newer goal";

/// As move_base has it: what is not a rotation about the vertical is most likely a mistake.
double headingOf(const geometry_msgs::Quaternion& given, const std::string& name) {
  tf2::Quaternion rotation(given.x, given.y, given.z, given.w);
  const double length = rotation.length2();
  if (!std::isfinite(length) || length < 1e-6) {
    throw InvalidRequest(text(name, ".pose.orientation is (", given.x, ", ", given.y, ", ", given.z, ", ", given.w,
                              "), which is no rotation; w is 1 for a heading of 0"));
  }
  rotation.normalize();
  if (tf2::quatRotate(rotation, tf2::Vector3(0.0, 0.0, 1.0)).z() < kUpright) {
    throw InvalidRequest(text(name, ".pose.orientation is (", given.x, ", ", given.y, ", ", given.z, ", ", given.w,
                              "); only rotations about the vertical are driven to: x and y must be 0"));
  }
  return tf2::getYaw(rotation);
}

}  // namespace

MoveBaseAdapter::~MoveBaseAdapter() {
  endPlans();
  make_plan_.shutdown();
  if (front_) front_->close();
  {
    // A goal that the service does not know yet ends when it has been answered, and one that waits is not sent then.
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.reset();
    if (in_work_) cancelInWork(in_work_->arrived.id, "the unloading of " + getName());
  }
  calls_.stop();
  plans_.stop();
  goals_.reset();
  front_.reset();
}

void MoveBaseAdapter::start() {
  std::string kind = "lane_follow";
  parameters().read("service", &kind);
  std::string service_name;
  parameters().readName("service_name", &service_name);
  service_ = GoalPoseService::make(kind, service_name.empty() ? "external_command/" + kind : service_name);
  parameters().readName("action_name", &action_name_);
  if (parameters().has("goal_name")) goal_topic_.clear();
  parameters().readName("goal_name", &goal_topic_);
  parameters().read("use_heading", &uses_heading_);
  if (kind != "lane_follow") uses_heading_ = true;
  callers_ = readCallerLimits(parameters());
  // Apart from the ids that the registry gives, which count on from the milliseconds of its start.
  next_id_ = static_cast<std::int64_t>(ros::WallTime::now().toNSec() / 1000);
}

void MoveBaseAdapter::open() {
  goals_ = std::make_unique<ActionGoals>(context(), action_name_);
  MoveBaseFront::Callbacks front;
  front.require = [this](const std::string& caller) { callers_.require(caller, action_name_); };
  front.goal = [this](MoveBaseFront::Arrived goal) { take(std::move(goal)); };
  front.cancel = [this](const std::string& id) { cancel(id); };
  front.tick = [this] { tick(); };
  front_ =
      std::make_unique<MoveBaseFront>(context(), getNodeHandle(), action_name_, goal_topic_, *goals_, std::move(front));
  BoundedServiceCallbacks<nav_msgs::GetPlan> callbacks;
  callbacks.answer = [this](const nav_msgs::GetPlan::Request& request, const MessageSize& /*size*/,
                            const ros::M_string& header) {
    const auto caller = header.find("callerid");
    return makePlan(request, caller == header.end() ? std::string() : caller->second);
  };
  callbacks.refuse = [this](const ros::SerializedMessage& /*request*/, const ros::M_string& /*header*/) {
    logLater(LogLevel::kWarn,
             text(getName(), ": a request for a plan was refused: ", statusFrom(std::current_exception(), 0).message));
    return nav_msgs::GetPlan::Response();
  };
  ros::AdvertiseServiceOptions service =
      boundedService<nav_msgs::GetPlan>(action_name_ + "/make_plan", std::move(callbacks), context().params().requests);
  service.callback_queue = plans_.queue();
  make_plan_ = getNodeHandle().advertiseService(service);
  if (!make_plan_) {
    throw InternalError(text("service ", service.service, " is advertised by this process already; is ", getName(),
                             " loaded twice, or has another one the same action_name? That of this one is set by ",
                             parameters().nameOf("action_name")));
  }
  front_->open();
}

void MoveBaseAdapter::take(MoveBaseFront::Arrived goal) {
  Request request{std::move(goal), ros::WallTime::now(), next_id_++};
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_) goals_->cancel(waiting_->arrived.id, kNewer);
    if (in_work_) cancelInWork(in_work_->arrived.id, kNewer);
    waiting_ = std::move(request);
  }
  calls_.post([this] { carryOutNext(); });
}

void MoveBaseAdapter::cancel(const std::string& id) {
  const std::lock_guard<std::mutex> lock(mutex_);
  goals_->cancel(id, "the client of its goal");
  if (in_work_ && in_work_->arrived.id == id) cancelInWork(id, "the client of its goal");
}

void MoveBaseAdapter::cancelInWork(const std::string& id, const std::string& by) {
  goals_->cancel(id, by);
  in_work_->is_cancelled = true;
  context().cancelById(in_work_->command_id, by);
}

void MoveBaseAdapter::tick() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (in_work_ && in_work_->is_cancelled) context().cancelById(in_work_->command_id, "its goal");
}

void MoveBaseAdapter::carryOutNext() {
  Request request;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (!waiting_) return;  // a newer one has taken its place, and was carried out
    request = *std::move(waiting_);
    waiting_.reset();
    if (!goals_->begin(request.arrived.goal)) return goals_->cancel(driven_, "the cancel of a newer goal");
    in_work_ = request;
  }
  const CommandStatus status = carryOut(request);
  bool is_last = false;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    in_work_.reset();
    is_last = !waiting_;
  }
  if (hasEnded(status)) {
    // The vehicle must not drive on to a goal that nobody has any more.
    if (is_last) goals_->cancel(driven_, text("a newer goal that is not driven: ", status.message));
    logLater(LogLevel::kWarn, text(getName(), ": goal of ", request.arrived.caller, " refused: ", status.message));
  } else {
    driven_ = request.arrived.id;
  }
  goals_->answered(request.arrived.goal, status);
}

CommandStatus MoveBaseAdapter::carryOut(const Request& request) {
  try {
    const CommandStatus status = call(request);
    if (hasEnded(status)) return status;
    const std::optional<CommandSerial> serial = context().registry().serialOf(status.command_id);
    if (!serial) throw InternalError(text("command ", status.command_id, " was sent, and is not known"));
    try {
      goals_->admitted(request.arrived.goal, *serial);
    } catch (const Cancelled&) {
      return context().cancel(*serial, "the client of its goal").status;
    }
    return status;
  } catch (...) {
    return statusFrom(std::current_exception(), 0);
  }
}

CommandStatus MoveBaseAdapter::call(const Request& request) {
  GoalPoseService::Goal goal;
  goal.command_id = request.command_id;
  goal.pose = toGoal(request.arrived.target, "target_pose", uses_heading_);
  goal.has_heading = uses_heading_;
  const GoalPoseService::Answer answer =
      service_->call(getNodeHandle(), goal, arrivalHeader(context().gate(), request.arrived.arrival, request.time));
  if (!hasEnded(answer.status)) tellWarnings(request.arrived.caller, answer);
  return answer.status;
}

/// move_base's feedback and result have no place for them.
void MoveBaseAdapter::tellWarnings(const std::string& caller, const GoalPoseService::Answer& answer) {
  if (answer.warnings.empty()) return;
  std::string line =
      text(getName(), ": goal of ", caller, " became command ", answer.status.command_id, ", which has warnings: ");
  for (const std::string& warning : answer.warnings) line += (&warning == &answer.warnings[0] ? "" : "; ") + warning;
  logLater(LogLevel::kWarn, warnings_, line);
}

nav_msgs::GetPlan::Response MoveBaseAdapter::makePlan(const nav_msgs::GetPlan::Request& request,
                                                      const std::string& caller) {
  nav_msgs::GetPlan::Response response;
  response.plan.header.frame_id = context().params().map_frame;
  response.plan.header.stamp = ros::Time::now();
  try {
    PlannedPath path;
    plan_line_.run([&] { path = findPlan(request, caller); });
    for (const PathPoint& point : path.points) {
      response.plan.poses.push_back(
          toPoseStamped({point.x, point.y, point.heading}, response.plan.header.frame_id, response.plan.header.stamp));
    }
  } catch (...) {
    // move_base answers with an empty plan, too.
    tellNoPlan(caller, statusFrom(std::current_exception(), 0));
  }
  return response;
}

void MoveBaseAdapter::tellNoPlan(const std::string& caller, const CommandStatus& status) {
  const std::string line = text(getName(), ": no plan for ", caller, ": ", status.message);
  if (status.error_code != CommandStatus::NOT_READY) return logLater(LogLevel::kWarn, line);
  logLater(LogLevel::kWarn, busy_log_, line);  // who is told that tends to ask again at once
  busy_pace_.pauseIfFlooded();
}

void MoveBaseAdapter::endPlans() {
  plan_line_.end([this] { context().cancelById(plan_in_work_, "the unloading of " + getName()); });
}

PlannedPath MoveBaseAdapter::findPlan(const nav_msgs::GetPlan::Request& request, const std::string& caller) {
  callers_.require(caller, action_name_ + "/make_plan");
  requireNotNegative(request.tolerance, "tolerance");
  GoalPoseService::Goal goal;
  goal.pose = toGoal(request.goal, "goal", uses_heading_);
  goal.has_heading = uses_heading_;
  if (!request.start.header.frame_id.empty()) goal.start = toGoal(request.start, "start", true);
  const auto run = [&](GoalPoseService::Goal tried) {
    plan_line_.throwIfEnded();
    tried.command_id = plan_in_work_ = next_id_++;
    return service_->call(getNodeHandle(), tried, {});
  };
  return external_command::findPlan(run, goal, request.tolerance);
}

Pose2d MoveBaseAdapter::toGoal(const geometry_msgs::PoseStamped& pose, const std::string& name,
                               bool has_heading) const {
  requireFinite(pose.pose.position, name + ".pose.position");
  const Pose2d given{pose.pose.position.x, pose.pose.position.y,
                     has_heading ? headingOf(pose.pose.orientation, name) : 0.0};
  try {
    return compose(context().vehiclePose().ofFrame(pose.header.frame_id), given);
  } catch (const InvalidRequest& error) {
    throw InvalidRequest(text(name, ".", error.what()));  // it names header.frame_id, of which there are several
  }
}

}  // namespace external_command
