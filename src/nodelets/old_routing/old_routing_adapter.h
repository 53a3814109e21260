// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "external_command/CommandStatus.h"
#include "external_command/RoutingRequest.h"
#include "external_command/ros/command_processor.h"
#include "routing_request_converter.h"

namespace external_command {

/// Turns messages of older programs into calls of the command services: a RoutingRequest into valet parking where it
/// names a parking space, else into lane follow; a PoseStamped (rviz's "2D Nav Goal") into lane follow.
/// What is refused is logged and answered by a RoutingResponse with the error.
class OldRoutingAdapter : public CommandProcessor {
 public:
  OldRoutingAdapter() = default;
  ~OldRoutingAdapter() override;

  /// What a service says of a command.
  struct Answer {
    CommandStatus status;
    std::vector<std::string> warnings;
  };

 private:
  void start() override;
  void open() override;

  void takeGoal(const geometry_msgs::PoseStamped& goal);

  /// A request in line. What stops the vehicle after it came in stops it too.
  struct Waiting {
    RoutingRequest::ConstPtr request;
    ArrivalNumber arrival = 0;
    ros::WallTime time;  ///< when it came in
  };

  /// Puts the request in line and returns at once; the oldest of too many is refused.
  void take(const RoutingRequest::ConstPtr& request);

  void carryOutNext();

  /// Calls the service that the request is for.
  /// @return the service's answer. @throws Error  there is none, or the request makes no command.
  Answer carryOut(const Waiting& waiting);

  void refuse(const RoutingRequest& request, const CommandStatus& status);

  std::string request_topic_ = "routing_request";
  std::string goal_topic_;  ///< empty: not subscribed
  std::string lane_follow_service_ = "external_command/lane_follow";
  std::string valet_parking_service_ = "external_command/valet_parking";
  std::optional<RoutingRequestConverter> converter_;
  ros::Publisher response_publisher_;
  std::mutex mutex_;
  std::deque<Waiting> waiting_;            ///< guarded by mutex_
  std::optional<Executor> take_executor_;  // before its subscribers
  ros::Subscriber request_subscriber_, goal_subscriber_;
  Executor executor_{ExecutorOptions{"the adapter's executor of calls"}};  // last: joins before the rest goes
};

}  // namespace external_command
