// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/service_server.h>

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "external_command/CommandLogEntry.h"
#include "external_command/ros/caller_limits.h"
#include "external_command/ros/command_action.h"
#include "external_command/ros/command_processor.h"
#include "external_command/ros/goal_arrival.h"
#include "external_command/ros/log_writer.h"

namespace external_command {

class RefusalPace;

/// The part of ServiceCommandProcessor that does not depend on the service: admission, statuses, log.
class CommandService : public CommandProcessor {
 public:
  ~CommandService() override;

 protected:
  struct Threads {
    unsigned count = 1;  ///< how many requests may run at once
    ExecutorPriority priority = ExecutorPriority::kNormal;
  };

  /// @param service  default of the parameter `input_command_name`.
  explicit CommandService(std::string service);

  /// Of the processor's executor. Asked once, after start().
  virtual Threads threads() const { return {}; }

  /// Stops serving, cancels the plans in work and waits for requests in work. Must be called by the destructor of the
  /// most derived class: a request in work calls its virtual functions.
  void stopServing();

  /// Reads parameters and subscribes to the vehicle's reports.
  void start() override;

  /// Declares from start() on, until stopServing(), what commands of this service need: they are refused, or do not
  /// end, where `check` throws. See Conditions.
  void needs(const std::string& condition, Conditions::Check check);
  void needsMap();
  void needsPose();

  /// Advertises the service. @throws InternalError  another processor of this process has that service.
  void open() override;

  /// What opens the action beside the service. To be called before start().
  using ActionMaker = std::function<std::unique_ptr<CommandAction>()>;
  void setAction(ActionMaker maker) { make_action_ = std::move(maker); }

  /// Called by stopServing() while requests may be in work: ends what they do for long.
  virtual void cancelWork() {}

  /// What the registry knows this processor as: its nodelet name.
  const std::string& id() const { return getName(); }

  CommandOwner owner() const;

  const std::string& serviceName() const { return service_name_; }
  std::string resolvedName() const { return getNodeHandle().resolveName(service_name_); }
  Executor& executor() { return *executor_; }

  /// Called when a request became a command, before that is executed; or the command that it is a retry of. What it
  /// throws refuses the request.
  using OnAdmitted = std::function<void(const AdmittedCommand&)>;

  /// A request as it came in.
  struct Incoming {
    std::int64_t wanted_id = 0;  ///< 0 or below: none wished
    std::uint64_t digest = 0;
    bool acts_always = false;  ///< carried out whatever its id
    ArrivalNumber arrival = 0;
    OnAdmitted on_admitted = {};
  };

  /// When the request that is being served came in: when the network thread handed it over, however long it waited
  /// since; or, where it came another way, now.
  ArrivalNumber arrivalOfThisCallback() const;

  /// `execute` is called unless the request is a retry.
  CommandStatus admitAndExecute(const Incoming& request,
                                const std::function<CommandStatus(const AdmittedCommand&)>& execute);

  /// The status of a request refused by an exception that is being handled. Logs it.
  CommandStatus refuse(std::int64_t wanted_id);

  /// The same for a goal that came with a fault.
  CommandStatus refuseGoal(const GoalArrival& how);

  /// Writes the answer to the log, behind the answer itself; of a flood of refusals 20 a second.
  void tell(const CommandStatus& status);

  /// True where somebody records the requests and their answers.
  bool isLogged() const { return log_publisher_.getNumSubscribers() > 0; }
  void log(CommandLogEntry entry) const;

  /// Logs a request that could not be read.
  void logRefusal(const std::string& caller, const CommandStatus& status) const;

  /// By the parameters `enabled` and `allowed_callers`.
  /// @throws InvalidRequest  the service is switched off, or not meant for the node `caller`.
  void requireAllowed(const std::string& caller) const { callers_.require(caller, service_name_); }

  /// The node that calls; empty where it does not say.
  static std::string callerOf(const ros::M_string& connection_header);

 private:
  virtual ros::AdvertiseServiceOptions serviceOptions() = 0;
  void openService();

  std::string service_name_;
  CallerLimits callers_;
  std::atomic<std::uint64_t> refused_{0};
  LogThrottle refusals_{0.05};
  ros::Publisher log_publisher_;
  std::vector<Conditions::Entry> conditions_;
  std::vector<ros::Subscriber> report_subscribers_;
  ros::ServiceServer server_;
  ActionMaker make_action_;  ///< empty: there is no action
  std::unique_ptr<CommandAction> action_;
  std::unique_ptr<RefusalPace> refusal_pace_;
  std::unique_ptr<Executor> executor_;
};

}  // namespace external_command
