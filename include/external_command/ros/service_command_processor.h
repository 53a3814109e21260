// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/advertise_service_options.h>
#include <ros/service_server.h>

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "external_command/CommandLogEntry.h"
#include "external_command/ros/any_message.h"
#include "external_command/ros/command_processor.h"
#include "external_command/ros/plans_in_work.h"
#include "external_command/ros/status.h"

namespace external_command {

/// The part of ServiceCommandProcessor that does not depend on the service: admission, statuses, log.
class CommandService : public CommandProcessor {
 public:
  ~CommandService() override;

 protected:
  /// @param service  default of the parameter `input_command_name`.
  /// @param threads  how many requests may run at once.
  CommandService(std::string service, unsigned threads);

  /// Stops serving, cancels the plans in work and waits for requests in work. Must be called by the destructor of the
  /// most derived class: a request in work calls its virtual functions.
  void stopServing();

  /// Reads parameters and subscribes to the vehicle's reports.
  void start() override;

  /// Advertises the service. @throws InternalError  another processor of this process has that service.
  void open() override;

  /// What the registry knows this processor as: its nodelet name.
  const std::string& id() const { return getName(); }

  const std::string& serviceName() const { return service_name_; }
  DedicatedLane& lane() { return *lane_; }
  PlansInWork& plansInWork() { return plans_in_work_; }
  PlansInWork& dryRunsInWork() { return dry_runs_in_work_; }

  /// Called with the request's id (0 or below: none wished) and digest; `execute` is called with the id given to it,
  /// unless the request is a retry.
  CommandStatus admitAndExecute(std::int64_t wanted_id, std::uint64_t digest,
                                const std::function<CommandStatus(std::int64_t)>& execute);

  /// The status of a request refused by an exception that is being handled. Logs it.
  CommandStatus refuse(std::int64_t wanted_id);

  /// Writes the answer to the log, behind the answer itself.
  void tell(const CommandStatus& status) const;

  /// True where somebody records the requests and their answers.
  bool isLogged() const { return log_publisher_.getNumSubscribers() > 0; }
  void log(CommandLogEntry entry) const;

 private:
  virtual ros::AdvertiseServiceOptions serviceOptions() = 0;

  std::string service_name_;
  const unsigned threads_;
  ros::Publisher log_publisher_;
  std::vector<ros::Subscriber> report_subscribers_;
  ros::ServiceServer server_;
  PlansInWork plans_in_work_, dry_runs_in_work_;
  std::unique_ptr<DedicatedLane> lane_;
};

/// Equal for two commands that differ in stamp and id only.
template <class Command>
std::uint64_t digestOf(Command command) {
  command.header.stamp = ros::Time();
  command.header.seq = 0;
  command.command_id = 0;
  const ros::SerializedMessage bytes = ros::serialization::serializeMessage(command);
  return std::hash<std::string_view>()({reinterpret_cast<const char*>(bytes.buf.get()), bytes.num_bytes});
}

/// One service with a request `command` and a response `status`: check, admit, execute, record, log. The service call
/// itself always succeeds; the answer is in the status.
///
/// A derived class must  implement check() and execute(), and call stopServing() in its destructor.
/// Both run on the processor's own lane, several requests at once where `threads` says so.
template <class Service>
class ServiceCommandProcessor : public CommandService {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Command = typename Request::_command_type;

 protected:
  explicit ServiceCommandProcessor(const std::string& service, unsigned threads = 1)
      : CommandService(service, threads) {}

  /// Looks at the request only: changes nothing, needs no map and no vehicle.
  /// @throws InvalidRequest, StaleRequest  the text names field, value and what was expected.
  virtual void check(const Command& command) const = 0;

  /// Carries the command out. `command.command_id` is positive. The status it returns is the answer; RUNNING leaves the
  /// command running, anything else ends it.
  /// @throws Error  nothing was sent; becomes the status.
  virtual CommandStatus execute(const Command& command, const CommandGate::Arrival& arrival, Response* response) = 0;

  /// Does with a command that came another way what the service does: check, admit, execute, record, log.
  /// To be called on the processor's lane.
  Response process(const Command& request, const std::string& caller) {
    const auto arrival = context().gate().arrive();
    const ros::Time begin = ros::Time::now();
    const ros::SteadyTime started = ros::SteadyTime::now();
    Response response;
    response.status = answer(request, arrival, &response);

    if (!isLogged()) return response;
    CommandLogEntry entry;
    entry.header.stamp = begin;
    entry.caller = caller;
    entry.request = packAny(request);
    entry.reply = response.status;
    entry.duration = (ros::SteadyTime::now() - started).toSec();
    log(std::move(entry));
    return response;
  }

 private:
  using Event = ros::ServiceEvent<Request, Response>;

  ros::AdvertiseServiceOptions serviceOptions() final {
    ros::AdvertiseServiceOptions options;
    const boost::function<bool(Event&)> callback = [this](Event& event) { return serve(event); };
    options.initBySpecType<Event>(serviceName(), callback);
    return options;
  }

  bool serve(Event& event) {
    event.getResponse() = process(event.getRequest().command, event.getCallerName());
    return true;
  }

  CommandStatus answer(const Command& request, const CommandGate::Arrival& arrival, Response* response) {
    try {
      check(request);
      return admitAndExecute(request.command_id, digestOf(request), [&](std::int64_t id) {
        Command command = request;
        command.command_id = id;
        return execute(command, arrival, response);
      });
    } catch (...) {
      return refuse(request.command_id);
    }
  }
};

}  // namespace external_command
