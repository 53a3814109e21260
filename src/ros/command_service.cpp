// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_service.h"

#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/refusal_pace.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

/// What a caller may well ask again at once.
bool asksForAnother(const CommandStatus& status) {
  return status.error_code == CommandStatus::NOT_READY || status.error_code == CommandStatus::CANCELLED ||
         status.error_code == CommandStatus::SUPERSEDED;
}

}  // namespace

CommandService::CommandService(std::string service) : service_name_(std::move(service)) {}

CommandService::~CommandService() {
  if (executor_)
    logLater(LogLevel::kError, id() + ": its destructor did not call stopServing(); a late request would crash");
  stopServing();
}

void CommandService::stopServing() {
  if (action_) action_->stopTaking();
  if (executor_) cancelWork();  // first: to take the service back may wait for a request that is being answered
  server_.shutdown();
  conditions_.clear();
  executor_.reset();  // joins
  action_.reset();
}

void CommandService::start() {
  parameters().readName("input_command_name", &service_name_);
  callers_ = readCallerLimits(parameters());
  bool has_action = true;
  if (make_action_) parameters().read("actions", &has_action);
  if (!has_action) make_action_ = {};
  log_publisher_ = context().advertise<CommandLogEntry>(context().params().log_topic, false);
  ros::NodeHandle nh(getNodeHandle());
  nh.setCallbackQueue(context().reports().queue());
  // The callback outlives this object by no more than the context, which owns all that it uses.
  const auto report = [context = &context(), name = id()](const ros::MessageEvent<CommandStatus const>& event) {
    context->takeReport(*event.getConstMessage(), name);
  };
  for (const std::string& topic : topicNames("input_command_status_name", "planning/command_status")) {
    report_subscribers_.push_back(
        subscribeBounded<CommandStatus>(nh, topic, 100, report, context().params().requests, LongTexts::kTaken));
  }
}

void CommandService::needs(const std::string& condition, Conditions::Check check) {
  conditions_.push_back(context().conditions().add(condition, owner().service, std::move(check)));
}

void CommandService::needsMap() {
  needs("map", [&context = context()] { return context.mapWords(); });
}

void CommandService::needsPose() {
  needs("pose", [&context = context()] {
    context.vehiclePose().get();
    return "the vehicle's pose is known";
  });
}

void CommandService::open() {
  const Threads threads = this->threads();
  refusal_pace_ = std::make_unique<RefusalPace>(threads.count / 2);
  ExecutorOptions options;
  options.name = "the executor of " + id();
  options.threads = threads.count;
  options.priority = threads.priority;
  options.stamp = context().gate().arrivalStamp();
  executor_ = std::make_unique<Executor>(options);
  openService();
  if (make_action_) action_ = make_action_();
}

void CommandService::openService() {
  ros::AdvertiseServiceOptions service = serviceOptions();
  service.callback_queue = executor_->queue();
  server_ = getNodeHandle().advertiseService(service);
  if (server_) return;
  stopServing();
  throw InternalError(text("service ", resolvedName(), " is advertised by this process already; is the same processor ",
                           "loaded twice, or has another one the same name in its input_command_name? That of this ",
                           "one is set by ", parameters().nameOf("input_command_name")));
}

CommandOwner CommandService::owner() const { return {id(), service_name_.substr(service_name_.rfind('/') + 1)}; }

ArrivalNumber CommandService::arrivalOfThisCallback() const {
  const ArrivalNumber stamped = GuardedQueue::stampOfRunningCallback();
  return stamped > 0 ? stamped : context().gate().arrive();
}

CommandStatus CommandService::admitAndExecute(const Incoming& request,
                                              const std::function<CommandStatus(const AdmittedCommand&)>& execute) {
  CommandRegistry& registry = context().registry();
  CommandRegistry::Admission admission = request.acts_always
                                             ? registry.admitAlways(request.wanted_id, owner())
                                             : registry.admit(request.wanted_id, owner(), request.digest);
  if (admission.running) {
    if (request.on_admitted) request.on_admitted(admission.command);
    return *admission.running;
  }
  admission.command.arrival = request.arrival;
  CommandStatus status;
  try {
    if (request.on_admitted) request.on_admitted(admission.command);
    status = execute(admission.command);
  } catch (...) {
    status = statusFrom(std::current_exception(), admission.command.id);
  }
  if (!admission.note.empty()) status.message += "; " + admission.note;
  status.message = statusMessage(status.message);
  status.service = owner().service;
  if (hasEnded(status)) {
    const bool was_running = registry.update({admission.command.serial, status});
    if (!was_running) status = registry.statusOf(admission.command.serial).value_or(status);  // it was cancelled
  } else {
    registry.noteAnswer(admission.command.serial, status.message);
  }
  tell(status);
  if (asksForAnother(status) && refusal_pace_) refusal_pace_->pauseIfFlooded();
  return status;
}

CommandStatus CommandService::refuse(std::int64_t wanted_id) {
  const CommandStatus status = context().registry().refuse(statusFrom(std::current_exception(), wanted_id), owner());
  tell(status);
  return status;
}

CommandStatus CommandService::refuseGoal(const GoalArrival& how) {
  CommandStatus status;
  try {
    std::rethrow_exception(how.fault);
  } catch (...) {
    status = refuse(0);
  }
  logRefusal(how.caller, status);
  return status;
}

void CommandService::tell(const CommandStatus& status) {
  const bool is_refused = status.status == CommandStatus::ERROR;
  const std::string command = text(service_name_, " ", status.command_id);
  if (is_refused) {
    context().refusals().add(status.error_code);
    const std::uint64_t count = ++refused_;
    logLater(LogLevel::kWarn, refusals_,
             text(command, " refused: ", status.message, " (", count, " refused since the start)"));
  } else {
    logLater(LogLevel::kInfo, text(command, ": ", status.message));
  }
}

void CommandService::log(CommandLogEntry entry) const {
  entry.service = server_.getService();
  log_publisher_.publish(entry);
}

void CommandService::logRefusal(const std::string& caller, const CommandStatus& status) const {
  if (!isLogged()) return;
  CommandLogEntry entry;
  entry.header.stamp = status.header.stamp;
  entry.caller = caller;
  entry.reply = status;
  log(std::move(entry));
}

std::string CommandService::callerOf(const ros::M_string& connection_header) {
  const auto caller = connection_header.find("callerid");
  return caller == connection_header.end() ? "" : caller->second;
}

}  // namespace external_command
