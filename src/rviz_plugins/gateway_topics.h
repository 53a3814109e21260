// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <visualization_msgs/MarkerArray.h>

#include <chrono>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "gateway_state.h"

namespace external_command {

/// The topics of a gateway, received on a thread of its own. To be made and destroyed where it does no harm to wait for
/// the ROS master. Thread-safe.
class GatewayTopics {
 public:
  /// @param vehicle  its namespace.
  explicit GatewayTopics(const std::string& vehicle);
  ~GatewayTopics() { spinner_.stop(); }

  /// What has come since the last take().
  struct News {
    std::optional<Chassis> chassis;  ///< the newest that is not older than a second
    std::optional<Readiness> readiness;
    std::optional<CommandStatus> progress;
    std::vector<CommandStatus> statuses;  ///< each change; the oldest are dropped where many come
  };
  News take();

  void publishDraft(const visualization_msgs::MarkerArray& markers) { draft_publisher_.publish(markers); }
  void publishLookAt(const geometry_msgs::PointStamped& place) { look_at_publisher_.publish(place); }

 private:
  void onChassis(const Chassis::ConstPtr& chassis);
  void onReadiness(const Readiness::ConstPtr& readiness);
  void onProgress(const CommandStatus::ConstPtr& progress);
  void onStatus(const CommandStatus::ConstPtr& status);

  std::mutex mutex_;
  std::optional<Chassis> chassis_;
  std::chrono::steady_clock::time_point chassis_came_;
  std::optional<Readiness> readiness_;
  std::optional<CommandStatus> progress_;
  std::deque<CommandStatus> statuses_;

  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  ros::Subscriber chassis_subscriber_, readiness_subscriber_, progress_subscriber_, status_subscriber_;
  ros::Publisher draft_publisher_, look_at_publisher_;
  ros::AsyncSpinner spinner_;
};

}  // namespace external_command
