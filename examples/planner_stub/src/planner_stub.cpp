// SPDX-License-Identifier: Apache-2.0
// What a planning module owes external_command: it drives what it is sent, reports, and stops. The way itself is only
// counted, by Controller, whose place your own takes. scripts/planner_stub.py is the same in Python.
#include <external_command/CommandStatus.h>
#include <external_command/PlanningCommand.h>
#include <external_command/PlanningPad.h>
#include <external_command/PlanningState.h>
#include <external_command/SpeedCommand.h>
#include <ros/ros.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ec = external_command;

namespace {

constexpr double kPeriod = 0.1;    // of reports, and of the controller [s]
constexpr double kCreeping = 0.1;  // [m/s]
constexpr double kMaxAge = 5.0;    // a command that was sent longer before this node started is not driven any more [s]

/// Your controller takes its place. This one moves nothing: it counts the metres along the path, at the path's speeds,
/// and stands as soon as it is not called.
class Controller {
 public:
  double target_speed;  // [m/s]; 0: as the path says
  double speed_factor = 1.0;

  explicit Controller(const ec::PlanningCommand& command)
      : target_speed(command.target_speed), points_(command.path.points), commanded_speed_(command.target_speed) {}

  double driven() const { return driven_; }
  double length() const { return points_.back().s; }
  bool hasArrived() const { return next_ == points_.size(); }

  void restoreSpeed() {
    target_speed = commanded_speed_;
    speed_factor = 1.0;
  }

  void drive(double seconds) {
    while (seconds > 0.0 && !hasArrived() && speed_factor > 0.0) {
      const double step = std::min(seconds, (points_[next_].s - driven_) / speed());
      driven_ += step * speed();
      seconds -= step;
      if (seconds > 0.0) driven_ = points_[next_++].s;
    }
  }

 private:
  /// The speeds of the path are limits; 0 is where it ends, or changes the gear and goes on.
  double speed() const {
    const double limit = std::max({points_[next_ - 1].speed, points_[next_].speed, kCreeping});
    return speed_factor * (target_speed > 0.0 ? std::min(limit, target_speed) : limit);
  }

  ec::PlannedPath::_points_type points_;
  const double commanded_speed_;  // [m/s]; 0: as the path says
  double driven_ = 0.0;           // [m]
  std::size_t next_ = 1;          // the point that is driven to
};

/// No where one is missing, or is ahead of a clock that was set back: a stop then counts.
bool isEarlier(const ros::Time& stamp, const ros::Time& other) {
  return !stamp.isZero() && stamp < other && other <= ros::Time::now();
}

class PlannerStub {
 public:
  PlannerStub() {
    reports_ = nh_.advertise<ec::CommandStatus>("planning/command_status", 100);
    state_ = nh_.advertise<ec::PlanningState>("planning/state", 10, true);
    command_ = nh_.subscribe("planning/command", 10, &PlannerStub::onCommand, this);
    pad_ = nh_.subscribe("planning/pad", 10, &PlannerStub::onPad, this);
    speed_ = nh_.subscribe("planning/speed_command", 10, &PlannerStub::onSpeed, this);
    timer_ = nh_.createSteadyTimer(ros::WallDuration(kPeriod), &PlannerStub::onTick, this);
  }

 private:
  void onCommand(const ec::PlanningCommand& command) {
    // The topic is latched: a new connection brings the same message again.
    if (command.command_id == seen_id_ && command.header.stamp == seen_stamp_) return;
    seen_id_ = command.command_id;
    seen_stamp_ = command.header.stamp;
    if (!command.is_motion_command) return;           // for who starts later; it stops nobody
    started_ = std::min(started_, ros::Time::now());  // simulated time may have been set back
    if ((started_ - command.header.stamp).toSec() > kMaxAge) {
      return report(command.command_id, ec::CommandStatus::ERROR, "sent long before this planner started");
    }
    if (command.path.points.size() < 2) {
      return report(command.command_id, ec::CommandStatus::ERROR, "there is no path to drive");
    }
    command_id_ = command.command_id;
    sent_ = command.header.stamp;
    controller_.emplace(command);
    hold_.reset();
    if (last_stop_ && isEarlier(sent_, last_stop_->header.stamp)) {
      obey(last_stop_->action);  // it was sent after the command, and came first
    }
  }

  void onPad(const ec::PlanningPad& pad) {
    if (pad.action == ec::PlanningPad::STOP || pad.action == ec::PlanningPad::CLEAR_PLANNING) {
      if (isEarlier(pad.header.stamp, sent_)) return;  // topics are not in step: it is about an earlier command
      last_stop_ = pad;
    } else if (pad.action == ec::PlanningPad::RESUME_CRUISE) {
      last_stop_.reset();
    }
    obey(pad.action);
  }

  void obey(std::uint8_t action) {
    switch (action) {
      case ec::PlanningPad::STOP:
      case ec::PlanningPad::PULL_OVER:
        hold_ = action;
        break;
      case ec::PlanningPad::RESUME_CRUISE:
        hold_.reset();
        break;
      case ec::PlanningPad::CLEAR_PLANNING:
        controller_.reset();
        break;
      default:  // to follow, to change lanes, missions: what your planner can do
        report(0, ec::CommandStatus::ERROR, "this planner does not know the action " + std::to_string(action));
    }
  }

  void onSpeed(const ec::SpeedCommand& command) {
    if (!controller_) {
      report(command.command_id, ec::CommandStatus::ERROR, "nothing is driven whose speed could be changed");
    } else if (command.kind == ec::SpeedCommand::TARGET_SPEED_FACTOR) {
      controller_->speed_factor = command.target_speed_factor;
    } else if (command.kind == ec::SpeedCommand::TARGET_SPEED) {
      controller_->target_speed = command.target_speed;
    } else {
      controller_->restoreSpeed();
    }
  }

  void onTick(const ros::SteadyTimerEvent& /*event*/) {
    if (controller_ && !hold_) {
      controller_->drive(kPeriod);
      reportWay();
    } else if (controller_) {
      report(command_id_, ec::CommandStatus::RUNNING, "held at " + std::to_string(controller_->driven()) + " m");
    }
    if (hold_) report(0, ec::CommandStatus::FINISHED, "standing");  // once the vehicle stands; pads have no id
    ec::PlanningState state;
    state.header.stamp = ros::Time::now();
    state.scenario = scenario();
    state_.publish(state);
  }

  std::string scenario() const {
    if (hold_) return *hold_ == ec::PlanningPad::STOP ? "EMERGENCY_STOP" : "EMERGENCY_PULL_OVER";
    return controller_ ? "LANE_FOLLOW" : "IDLE";
  }

  void reportWay() {
    const std::string length = std::to_string(controller_->length()) + " m";
    if (controller_->hasArrived()) {
      report(command_id_, ec::CommandStatus::FINISHED, "driven " + length);
      controller_.reset();
    } else {
      report(command_id_, ec::CommandStatus::RUNNING,
             "driven " + std::to_string(controller_->driven()) + " of " + length);
    }
  }

  void report(std::int64_t command_id, std::uint8_t status, const std::string& message) {
    ec::CommandStatus report;
    report.header.stamp = ros::Time::now();  // one that is older than its command does not count
    report.command_id = command_id;
    report.status = status;
    report.message = message;
    if (status == ec::CommandStatus::ERROR) report.error_code = ec::CommandStatus::REFUSED_BY_VEHICLE;
    reports_.publish(report);
  }

  ros::NodeHandle nh_;
  ros::Publisher reports_, state_;
  ros::Subscriber command_, pad_, speed_;
  ros::SteadyTimer timer_;

  ros::Time started_ = ros::Time::now();
  std::int64_t seen_id_ = 0;
  ros::Time seen_stamp_;
  std::int64_t command_id_ = 0;               // of the motion command that is driven
  ros::Time sent_;                            // its stamp
  std::optional<Controller> controller_;      // while there is one
  std::optional<std::uint8_t> hold_;          // STOP or PULL_OVER of PlanningPad
  std::optional<ec::PlanningPad> last_stop_;  // the newest STOP or CLEAR_PLANNING that no START has lifted
};

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "planner_stub");
  const PlannerStub stub;
  ros::spin();
}
