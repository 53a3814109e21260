// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nav_msgs/GetPlan.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "external_command/ros/caller_limits.h"
#include "external_command/ros/command_processor.h"
#include "external_command/ros/refusal_pace.h"
#include "goal_pose_service.h"
#include "move_base_front.h"
#include "plan_line.h"

namespace external_command {

/// Serves what programs for move_base speak, by calls of one of the motion services: the action `move_base`, the
/// service `make_plan` and the topic `move_base_simple/goal`. One goal at a time: a newer one takes the place of an
/// older one, and ends its motion, too, where it cannot be driven itself. Belongs into the process of the component.
class MoveBaseAdapter : public CommandProcessor {
 public:
  MoveBaseAdapter() = default;
  ~MoveBaseAdapter() override;

 private:
  /// A goal, from its arrival until the service has answered.
  struct Request {
    MoveBaseFront::Arrived arrived;
    ros::WallTime time;
    std::int64_t command_id = 0;
    bool is_cancelled = false;
  };

  void start() override;
  void open() override;

  /// At the door: puts the goal in line in place of the one that is there, cancels what is being planned.
  void take(MoveBaseFront::Arrived goal);
  void cancel(const std::string& id);

  /// On the executor of calls.
  void carryOutNext();
  CommandStatus carryOut(const Request& request);
  CommandStatus call(const Request& request);
  void tellWarnings(const std::string& caller, const GoalPoseService::Answer& answer);

  /// On the executor of the goals.
  void tick();

  /// A plan that is in work cannot be cancelled before the service knows it: tried until it is.
  void cancelInWork(const std::string& id, const std::string& by);

  nav_msgs::GetPlan::Response makePlan(const nav_msgs::GetPlan::Request& request, const std::string& caller);
  void tellNoPlan(const std::string& caller, const CommandStatus& status);
  PlannedPath findPlan(const nav_msgs::GetPlan::Request& request, const std::string& caller);

  /// Lets no plan be made any more, and waits until the one in work has ended. To be called before the service is taken
  /// back: that waits for who is being answered, and roscpp before 1.15.10 keeps the one who plans from looking up its
  /// service meanwhile.
  void endPlans();

  /// In the map frame. @param has_heading  false: the orientation is not looked at.
  /// @throws InvalidRequest  not finite, not a rotation about the vertical, or of a frame that tf does not know.
  Pose2d toGoal(const geometry_msgs::PoseStamped& pose, const std::string& name, bool has_heading) const;

  std::string action_name_ = "move_base";
  std::string goal_topic_ = "move_base_simple/goal";
  bool uses_heading_ = true;
  CallerLimits callers_;
  std::unique_ptr<GoalPoseService> service_;
  std::atomic<std::int64_t> next_id_{0};

  std::mutex mutex_;
  std::optional<Request> waiting_, in_work_;  ///< guarded by mutex_
  std::string driven_;                        ///< id of the last goal that was sent; of the executor of calls

  std::unique_ptr<ActionGoals> goals_;
  std::unique_ptr<MoveBaseFront> front_;
  static constexpr unsigned kMostWaitingPlans = 4;
  PlanLine plan_line_{kMostWaitingPlans};
  std::atomic<std::int64_t> plan_in_work_{0};  ///< the id of its dry run
  RefusalPace busy_pace_{1};
  LogThrottle busy_log_{1.0}, warnings_{0.05};
  /// One for the plan in work, for each that waits, and two that say "busy", of which one may pause.
  Executor plans_{ExecutorOptions{"the move_base adapter's executor of plans", kMostWaitingPlans + 3}};
  ros::ServiceServer make_plan_;
  Executor calls_{ExecutorOptions{"the move_base adapter's executor of calls"}};
};

}  // namespace external_command
