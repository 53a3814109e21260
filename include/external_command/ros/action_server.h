// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <actionlib/server/action_server_base.h>
#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <ros/node_handle.h>
#include <ros/time.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/command_service.h"
#include "external_command/ros/goal_arrival.h"
#include "external_command/ros/goal_subscription.h"

namespace external_command {

/// actionlib's server, with topics of our own: bounded in size and pace, on an executor of their own, by a steady
/// clock. The list of goals in each status message is bounded too; actionlib keeps cancels of goals that it does not
/// know, and believes stamps of the future.
///
/// Who makes one must call close() before what the callbacks use goes.
template <class Action>
class BoundedActionServer : public actionlib::ActionServerBase<Action> {
  using Base = actionlib::ActionServerBase<Action>;

 public:
  ACTION_DEFINITION(Action)
  using GoalHandle = typename Base::GoalHandle;

  /// Called on door(). Neither may wait.
  struct Callbacks {
    std::function<void(GoalHandle goal, const GoalArrival& how)> goal;
    std::function<void(GoalHandle goal)> cancel;
  };

  /// @param name  of the action, resolved. @param most_goals  that have not ended; others come with a fault.
  BoundedActionServer(ProcessContext& context, const ros::NodeHandle& nh, std::string name, Callbacks callbacks,
                      std::size_t most_goals = 50)
      : Base([this](GoalHandle goal) { callbacks_.goal(goal, *arrived_); },
             [this](GoalHandle goal) { callbacks_.cancel(goal); }, false),
        context_(context),
        nh_(nh),
        name_(std::move(name)),
        callbacks_(std::move(callbacks)),
        most_goals_(most_goals),
        door_(ExecutorOptions{"the door of " + name_, 1, ExecutorPriority::kNormal, context.gate().arrivalStamp()}) {}

  ~BoundedActionServer() override { close(); }

  void open() {
    const boost::recursive_mutex::scoped_lock lock(this->lock_);  // actionlib drops what comes before it has started
    Base::start();
  }

  /// Takes no goals and cancels any more. Idempotent.
  void close() {
    goal_subscriber_.shutdown();
    cancel_subscriber_.shutdown();
    door_.stop();
  }

  /// Where goals and cancels come in.
  Executor& door() { return door_; }

  /// A goal that came another way. On door().
  void take(const ActionGoalConstPtr& goal, GoalArrival how) {
    pace_.pauseIfFlooded();
    {
      const boost::recursive_mutex::scoped_lock lock(this->lock_);
      // Simulated time was set back since: goals have stamps of a time that begins anew.
      if (this->last_cancel_ > latestStamp()) this->last_cancel_ = ros::Time();
      if (!how.fault && countAlive() >= most_goals_) {
        how.fault = std::make_exception_ptr(
            NotReady(text("busy: ", most_goals_, " goals of ", name_, " have not ended; send it again in a moment")));
      }
    }
    arrived_ = &how;
    Base::goalCallback(goal);
    arrived_ = nullptr;
    forgetEnded();
  }

  /// To be called some times per second, as actionlib does.
  void tick() {
    forgetEnded();
    const boost::recursive_mutex::scoped_lock lock(this->lock_);
    publishStatus();
  }

 private:
  static constexpr std::size_t kMostEnded = 100;
  static constexpr double kShown = 5.0;     // after its end, a goal stays in the list [s]
  static constexpr double kReleased = 0.5;  // after it is seen to have ended, nobody holds its entry any more [s]
  static constexpr std::uint32_t kQueueSize = 20;

  void initialize() override {
    result_ = context_.advertise<ActionResult>(name_ + "/result", false);
    feedback_ = context_.advertise<ActionFeedback>(name_ + "/feedback", false);
    status_ = context_.advertise<actionlib_msgs::GoalStatusArray>(name_ + "/status", true);
    nh_.setCallbackQueue(door_.queue());
    const RequestLimits& limits = context_.params().requests;
    const auto on_goal = [this](const ArrivedGoal<ActionGoal>& arrived, const std::string& caller) {
      take(arrived.goal, {caller, GuardedQueue::stampOfRunningCallback(), arrived.fault});
    };
    goal_subscriber_ = subscribeGoals<ActionGoal>(nh_, name_ + "/goal", kQueueSize, on_goal, limits);
    const auto on_cancel = [this](const ros::MessageEvent<actionlib_msgs::GoalID const>& event) {
      takeCancel(event.getConstMessage());
    };
    cancel_subscriber_ =
        subscribeBounded<actionlib_msgs::GoalID>(nh_, name_ + "/cancel", kQueueSize, on_cancel, limits);
  }

  void takeCancel(const actionlib_msgs::GoalID::ConstPtr& cancel) {
    pace_.pauseIfFlooded();
    Base::cancelCallback(cancel);
    forgetEnded();
    const boost::recursive_mutex::scoped_lock lock(this->lock_);
    // It would cancel goals that are still to come.
    if (this->last_cancel_ > latestStamp()) this->last_cancel_ = ros::Time::now();
  }

  ros::Time latestStamp() const {
    const double latest = ros::Time::now().toSec() + context_.params().max_future_stamp;
    return ros::Time(std::min(latest, ros::TIME_MAX.toSec() - 1.0));
  }

  std::size_t countAlive() const {
    return std::count_if(this->status_list_.begin(), this->status_list_.end(),
                         [](const auto& goal) { return !goal.handle_tracker_.expired(); });
  }

  /// Not from publishStatus(): actionlib calls that while it goes through the list.
  void forgetEnded() {
    const boost::recursive_mutex::scoped_lock lock(this->lock_);
    const ros::Time now = ros::Time::now();
    std::size_t spare = this->status_list_.size() - countAlive();
    auto goal = this->status_list_.begin();
    while (goal != this->status_list_.end()) {
      if (!goal->handle_tracker_.expired()) {
        ++goal;
        continue;
      }
      ros::Time& ended = goal->handle_destruction_time_;
      if (ended.isZero()) ended = now;  // a cancel without a stamp, of a goal that is not known
      // Whoever drops the last handle waits for the lock, and then writes to the entry.
      const auto seen = seen_ended_.emplace(goal->status_.goal_id.id, ros::SteadyTime::now()).first;
      const bool is_released = (ros::SteadyTime::now() - seen->second).toSec() > kReleased;
      const bool is_over = std::abs(now.toSec() - ended.toSec()) > kShown || spare > kMostEnded;
      if (!is_released || !is_over) {
        ++goal;
        continue;
      }
      --spare;
      seen_ended_.erase(seen);
      goal = this->status_list_.erase(goal);
    }
  }

  void publishResult(const actionlib_msgs::GoalStatus& status, const Result& result) override {
    const auto message = boost::make_shared<ActionResult>();
    message->header.stamp = ros::Time::now();
    message->status = status;
    message->result = result;
    result_.publish(message);
    publishStatus();
  }

  void publishFeedback(const actionlib_msgs::GoalStatus& status, const Feedback& feedback) override {
    const auto message = boost::make_shared<ActionFeedback>();
    message->header.stamp = ros::Time::now();
    message->status = status;
    message->feedback = feedback;
    feedback_.publish(message);
  }

  /// With the lock of the base held.
  void publishStatus() override {
    const auto message = boost::make_shared<actionlib_msgs::GoalStatusArray>();
    message->header.stamp = ros::Time::now();
    for (const auto& goal : this->status_list_) message->status_list.push_back(goal.status_);
    status_.publish(message);
  }

  ProcessContext& context_;
  ros::NodeHandle nh_;
  const std::string name_;
  const Callbacks callbacks_;
  const std::size_t most_goals_;
  ArrivalPace pace_;                                   ///< of the door
  std::map<std::string, ros::SteadyTime> seen_ended_;  ///< goals of the list, by id; guarded by the base's lock
  const GoalArrival* arrived_ = nullptr;               ///< of the goal that is being taken; of the door
  ros::Publisher result_, feedback_, status_;          ///< the context's: results leave, though this is gone
  ros::Subscriber goal_subscriber_, cancel_subscriber_;
  Executor door_;
};

}  // namespace external_command
