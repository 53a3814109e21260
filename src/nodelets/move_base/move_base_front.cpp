// SPDX-License-Identifier: Apache-2.0
#include "move_base_front.h"

#include <move_base_msgs/MoveBaseAction.h>

#include <cmath>
#include <utility>

#include "external_command/ros/action_server.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

using ActionServer = BoundedActionServer<move_base_msgs::MoveBaseAction>;

constexpr double kLookPeriod = 0.1;    // [s]
constexpr double kStatusPeriod = 0.2;  // of feedback and status [s]

class Client : public ClientGoal {
 public:
  Client(const ActionServer::GoalHandle& handle, ProcessContext& context) : handle_(handle), context_(context) {}

  void accept() override { handle_.setAccepted(); }

  void tell(const CommandStatus& /*status*/) override {
    move_base_msgs::MoveBaseFeedback feedback;
    try {
      feedback.base_position =
          toPoseStamped(context_.vehiclePose().get(), context_.params().map_frame, ros::Time::now());
    } catch (const Error&) {
      return;  // the localization has paused
    }
    handle_.publishFeedback(feedback);
  }

  void end(GoalEnd end, const CommandStatus& status) override {
    if (end == GoalEnd::kSucceeded) return handle_.setSucceeded({}, "Goal reached.");
    if (end == GoalEnd::kCanceled) return handle_.setCanceled({}, status.message);
    handle_.setAborted({}, status.message);
  }

 private:
  ActionServer::GoalHandle handle_;
  ProcessContext& context_;
};

}  // namespace

geometry_msgs::PoseStamped toPoseStamped(const Pose2d& pose, const std::string& frame, const ros::Time& stamp) {
  geometry_msgs::PoseStamped message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  message.pose.position.x = pose.x;
  message.pose.position.y = pose.y;
  message.pose.orientation.z = std::sin(0.5 * pose.heading);
  message.pose.orientation.w = std::cos(0.5 * pose.heading);
  return message;
}

class MoveBaseFront::Server {
 public:
  Server(ProcessContext& context, const ros::NodeHandle& nh, const std::string& action, std::string goal_topic,
         ActionGoals& goals, Callbacks callbacks)
      : context_(context),
        nh_(nh),
        goal_topic_(std::move(goal_topic)),
        goals_(goals),
        callbacks_(std::move(callbacks)),
        server_(context, nh, nh.resolveName(action),
                {[this](ActionServer::GoalHandle handle, const GoalArrival& how) { take(handle, how); },
                 [this](ActionServer::GoalHandle handle) { callbacks_.cancel(handle.getGoalID().id); }}) {}

  void open() {
    server_.open();
    look_timer_ = goals_.executor().every(
        kLookPeriod, [this] { goals_.look(); }, [this] { return goals_.areThere(); });
    status_timer_ = goals_.executor().every(kStatusPeriod, [this] { tellStatus(); });
    if (goal_topic_.empty()) return;
    nh_.setCallbackQueue(server_.door().queue());
    const auto on_goal = [this](const ros::MessageEvent<geometry_msgs::PoseStamped const>& event) {
      const auto goal = boost::make_shared<move_base_msgs::MoveBaseActionGoal>();
      goal->goal.target_pose = *event.getConstMessage();
      server_.take(goal, {event.getPublisherName(), GuardedQueue::stampOfRunningCallback(), {}});
    };
    poses_ = subscribeBounded<geometry_msgs::PoseStamped>(nh_, goal_topic_, 10, on_goal, context_.params().requests);
  }

  void close() {
    poses_.shutdown();
    server_.close();
    look_timer_.stop();
    status_timer_.stop();
  }

 private:
  /// move_base accepts whatever comes, and aborts what it cannot do.
  void take(const ActionServer::GoalHandle& handle, const GoalArrival& how) {
    Arrived arrived;
    arrived.id = handle.getGoalID().id;
    arrived.goal = goals_.add(arrived.id, std::make_unique<Client>(handle, context_), ActionGoals::Accept::kAtOnce);
    try {
      if (how.fault) std::rethrow_exception(how.fault);
      callbacks_.require(how.caller);
    } catch (...) {
      goals_.begin(arrived.goal);
      return goals_.answered(arrived.goal, statusFrom(std::current_exception(), 0));
    }
    arrived.target = handle.getGoal()->target_pose;
    arrived.caller = how.caller;
    arrived.arrival = how.arrival;
    callbacks_.goal(std::move(arrived));
  }

  void tellStatus() {
    server_.tick();
    goals_.tick();
    callbacks_.tick();
  }

  ProcessContext& context_;
  ros::NodeHandle nh_;
  const std::string goal_topic_;
  ActionGoals& goals_;
  const Callbacks callbacks_;
  ActionServer server_;
  ros::Subscriber poses_;
  Periodic look_timer_, status_timer_;
};

MoveBaseFront::MoveBaseFront(ProcessContext& context, const ros::NodeHandle& nh, const std::string& action,
                             const std::string& goal_topic, ActionGoals& goals, Callbacks callbacks)
    : server_(std::make_unique<Server>(context, nh, action, goal_topic, goals, std::move(callbacks))) {}

MoveBaseFront::~MoveBaseFront() { close(); }

void MoveBaseFront::open() { server_->open(); }

void MoveBaseFront::close() { server_->close(); }

}  // namespace external_command
