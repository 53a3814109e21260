// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "external_command/ros/any_message.h"
#include "external_command/ros/bounded_service.h"
#include "external_command/ros/command_service.h"
#include "external_command/ros/request_arrival.h"
#include "external_command/ros/status.h"

namespace external_command {

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
/// A derived class may   override threads(), actsAlways().
/// Both run on the processor's own executor, several requests at once where threads() says so.
template <class Service>
class ServiceCommandProcessor : public CommandService {
 public:
  using Request = typename Service::Request;
  using Response = typename Service::Response;
  using Command = typename Request::_command_type;

 protected:
  explicit ServiceCommandProcessor(const std::string& service) : CommandService(service) {}

  /// Serves the same as an action, too, under the name of the service. To be called in the constructor, in a .cpp file
  /// that includes action_front.h.
  template <class Action>
  void offerAction();

  /// Looks at the request only: changes nothing, needs no map and no vehicle.
  /// @throws InvalidRequest, StaleRequest  the text names field, value and what was expected.
  virtual void check(const Command& command) const = 0;

  /// True for a command that is carried out whatever its id and however often it comes: never a retry, never a
  /// duplicate.
  virtual bool actsAlways(const Command& /*command*/) const { return false; }

  /// Carries the command out. `command.command_id` is positive, the same as `admitted.id`. The status it returns is the
  /// answer; RUNNING leaves the command running, anything else ends it.
  /// @throws Error  nothing was sent; becomes the status.
  virtual CommandStatus execute(const Command& command, const AdmittedCommand& admitted, Response* response) = 0;

  /// Does with a command that came another way what the service does: check, admit, execute, record, log.
  /// To be called on the processor's executor.
  Response process(const Command& request, const std::string& caller, OnAdmitted on_admitted = {}) {
    return process(request, Origin{caller, arrivalOfThisCallback(), {}, std::move(on_admitted)});
  }

 private:
  /// Where a request comes from, and how large it is.
  struct Origin {
    std::string caller;
    ArrivalNumber arrival = 0;
    MessageSize size;
    OnAdmitted admitted = {};
  };

  Response process(const Command& request, const Origin& origin) {
    const ros::Time begin = ros::Time::now();
    const ros::SteadyTime started = ros::SteadyTime::now();
    Response response;
    response.status = answer(request, origin, &response);

    if (!isLogged()) return response;
    CommandLogEntry entry;
    entry.header.stamp = begin;
    entry.caller = origin.caller;
    entry.request = packAny(request);
    entry.reply = response.status;
    entry.duration = (ros::SteadyTime::now() - started).toSec();
    log(std::move(entry));
    return response;
  }

  ros::AdvertiseServiceOptions serviceOptions() final {
    BoundedServiceCallbacks<Service> callbacks;
    callbacks.answer = [this](const Request& request, const MessageSize& size, const ros::M_string& header) {
      const ArrivalNumber arrival = earlierArrival(header, context().gate(), arrivalOfThisCallback());
      return process(request.command, Origin{callerOf(header), arrival, size, {}});
    };
    callbacks.refuse = [this](const ros::SerializedMessage& request, const ros::M_string& header) {
      Response response;
      response.status = refuse(idOf(request));
      logRefusal(callerOf(header), response.status);
      return response;
    };
    return boundedService<Service>(serviceName(), std::move(callbacks), context().params().requests);
  }

  /// The command's header and id come first; 0 where not even these are there.
  static std::int64_t idOf(const ros::SerializedMessage& request) {
    try {
      ros::serialization::IStream bytes(request.message_start, static_cast<std::uint32_t>(lengthOf(request)));
      std_msgs::Header header;
      std::int64_t id = 0;
      bytes.next(header);
      bytes.next(id);
      return id;
    } catch (const ros::Exception&) {
      return 0;
    }
  }

  /// What always acts is refused for nothing that has no part in it.
  void requireWithinLimits(const Origin& origin) const {
    requireAllowed(origin.caller);
    context().params().requests.requireTexts(origin.size, ros::message_traits::definition<Request>());
  }

  CommandStatus answer(const Command& request, const Origin& origin, Response* response) {
    try {
      const bool acts_always = actsAlways(request);
      if (!acts_always) requireWithinLimits(origin);
      check(request);
      const Incoming incoming{request.command_id, digestOf(request), acts_always, origin.arrival, origin.admitted};
      return admitAndExecute(incoming, [&](const AdmittedCommand& admitted) {
        Command command = request;
        command.command_id = admitted.id;
        return execute(command, admitted, response);
      });
    } catch (...) {
      return refuse(request.command_id);
    }
  }
};

}  // namespace external_command
