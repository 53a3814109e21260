// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "external_command/ros/action_goals.h"
#include "external_command/ros/action_server.h"
#include "external_command/ros/command_action.h"
#include "external_command/ros/service_command_processor.h"

namespace external_command {

/// The action beside a service: each goal is one request, carried out on the processor's own executor. Its goal has a
/// field `command`, its feedback `status`, its result `status` and, where the service's response has one, `report`.
///
/// To be included by the .cpp file of a processor, not by its header: actionlib takes long to compile.
template <class Action, class Service>
class ActionFront : public CommandAction {
 public:
  using Command = typename Service::Request::_command_type;
  using Response = typename Service::Response;

  struct Processor {
    Executor* executor = nullptr;  ///< that requests are carried out on; no longer used after stopTaking()
    /// Carries out what came as a goal. @param admitted  told when it becomes a command; what it throws refuses it.
    std::function<Response(const Command& command, const GoalArrival& how,
                           const std::function<void(const AdmittedCommand&)>& admitted)>
        process;
    std::function<CommandStatus(const GoalArrival& how)> refuse;  ///< a goal with a fault
  };

  /// @param name  of the service, resolved.
  ActionFront(ProcessContext& context, const ros::NodeHandle& nh, const std::string& name, Processor processor)
      : processor_(std::move(processor)), server_(context, nh, name, callbacks()), goals_(context, name) {
    server_.open();
    look_timer_ = goals_.executor().every(
        kLookPeriod, [this] { goals_.look(); }, [this] { return goals_.areThere(); });
    status_timer_ = goals_.executor().every(kStatusPeriod, [this] {
      server_.tick();
      goals_.tick();
    });
  }

  ~ActionFront() override {
    stopTaking();
    look_timer_.stop();
    status_timer_.stop();
  }

  void stopTaking() override { server_.close(); }

 private:
  using Server = BoundedActionServer<Action>;
  using GoalHandle = typename Server::GoalHandle;

  static constexpr double kLookPeriod = 0.1;    // [s]
  static constexpr double kStatusPeriod = 0.2;  // of feedback and status [s]

  class Client : public ClientGoal {
   public:
    explicit Client(const GoalHandle& handle) : handle_(handle) {}

    /// Before the end.
    void keepReport(Response&& response) { moveReport(&response, &result_, 0); }

    void accept() override { handle_.setAccepted(); }

    void tell(const CommandStatus& status) override {
      typename Server::Feedback feedback;
      feedback.status = status;
      handle_.publishFeedback(feedback);
    }

    void end(GoalEnd end, const CommandStatus& status) override {
      result_.status = status;
      switch (end) {
        case GoalEnd::kSucceeded:
          return handle_.setSucceeded(result_, status.message);
        case GoalEnd::kAborted:
          return handle_.setAborted(result_, status.message);
        case GoalEnd::kCanceled:
          return handle_.setCanceled(result_, status.message);
        case GoalEnd::kRejected:
          return handle_.setRejected(result_, status.message);
      }
    }

   private:
    template <class From, class To>
    static auto moveReport(From* response, To* result, int) -> decltype(result->report = response->report, void()) {
      result->report = std::move(response->report);
    }
    template <class From, class To>
    static void moveReport(From* /*response*/, To* /*result*/, long) {}

    GoalHandle handle_;
    typename Server::Result result_;
  };

  typename Server::Callbacks callbacks() {
    return {[this](GoalHandle handle, const GoalArrival& how) { take(handle, how); },
            [this](GoalHandle handle) { goals_.cancel(handle.getGoalID().id, "the client of its goal"); }};
  }

  void take(const GoalHandle& handle, const GoalArrival& how) {
    auto made = std::make_unique<Client>(handle);
    Client* const client = made.get();  // lives as long as the goal
    const ActionGoals::GoalPtr goal = goals_.add(handle.getGoalID().id, std::move(made));
    if (how.fault) {
      goals_.begin(goal);
      return goals_.answered(goal, processor_.refuse(how));
    }
    processor_.executor->post([this, goal, client, how, content = handle.getGoal()] {
      if (goals_.begin(goal)) goals_.answered(goal, carryOut(goal, client, *content, how));
    });
  }

  CommandStatus carryOut(const ActionGoals::GoalPtr& goal, Client* client, const typename Server::Goal& content,
                         const GoalArrival& how) try {
    Response response = processor_.process(
        content.command, how, [&](const AdmittedCommand& command) { goals_.admitted(goal, command.serial); });
    CommandStatus status = response.status;
    client->keepReport(std::move(response));
    return status;
  } catch (...) {
    return statusFrom(std::current_exception(), 0);
  }

  const Processor processor_;
  Server server_;
  ActionGoals goals_;  // after the server, by which it tells its clients how they end
  Periodic look_timer_, status_timer_;
};

/// Opens the action when the service is opened, unless the parameter `actions` is false.
template <class Service>
template <class Action>
void ServiceCommandProcessor<Service>::offerAction() {
  this->setAction([this] {
    using Front = ActionFront<Action, Service>;
    typename Front::Processor processor;
    processor.executor = &this->executor();
    processor.process = [this](const Command& command, const GoalArrival& how,
                               const std::function<void(const AdmittedCommand&)>& admitted) {
      return process(command, Origin{how.caller, how.arrival, {}, admitted});
    };
    processor.refuse = [this](const GoalArrival& how) { return this->refuseGoal(how); };
    return std::make_unique<Front>(this->context(), this->getNodeHandle(), this->resolvedName(), std::move(processor));
  });
}

}  // namespace external_command
