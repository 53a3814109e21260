// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>

#include <exception>
#include <functional>
#include <memory>
#include <string>

#include "external_command/ros/action_goals.h"
#include "external_command/ros/process_context.h"

namespace external_command {

/// What clients of move_base speak: the action, and the topic of goals. actionlib takes long to compile, and stays in
/// the .cpp file.
class MoveBaseFront {
 public:
  /// A goal as it came in.
  struct Arrived {
    std::string id;
    ActionGoals::GoalPtr goal;
    geometry_msgs::PoseStamped target;
    std::string caller;
    ArrivalNumber arrival = 0;
  };

  struct Callbacks {
    std::function<void(const std::string& caller)> require;  ///< throws where that one may send no goals
    std::function<void(Arrived goal)> goal;                  ///< must not wait
    std::function<void(const std::string& id)> cancel;       ///< must not wait
    std::function<void()> tick;                              ///< on the executor of the goals, 5 times a second
  };

  /// @param action  its name. @param goal_topic  empty: none.
  /// @param goals   to go after close() and before this, by which they tell their clients how they end.
  MoveBaseFront(ProcessContext& context, const ros::NodeHandle& nh, const std::string& action,
                const std::string& goal_topic, ActionGoals& goals, Callbacks callbacks);
  ~MoveBaseFront();

  void open();

  /// No callback is called any more. Idempotent.
  void close();

 private:
  class Server;
  const std::unique_ptr<Server> server_;
};

geometry_msgs::PoseStamped toPoseStamped(const Pose2d& pose, const std::string& frame, const ros::Time& stamp);

}  // namespace external_command
