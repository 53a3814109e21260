// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <ros/subscriber.h>
#include <tf2_msgs/TFMessage.h>

#include <cstdint>
#include <mutex>
#include <string>

#include "external_command/ros/executor.h"
#include "external_command/ros/transform_store.h"

namespace external_command {

/// Listens to /tf and /tf_static on an executor of its own, and keeps what is good. Unlike tf2_ros::TransformListener,
/// whose thread ends the process where tf2 throws, no message ends or stops it. Thread-safe.
class TransformFeed {
 public:
  /// @param max_future_stamp  as for TransformStore [s].
  explicit TransformFeed(double max_future_stamp);
  ~TransformFeed();

  const TransformStore& store() const { return store_; }

  /// Why a transform was refused in the last seconds, and how many were; empty where none was.
  std::string recentRefusal() const;

 private:
  void take(const tf2_msgs::TFMessage& message, bool is_static);
  void noteRefusal(const std::string& reason);
  void subscribe(const std::string& topic, bool is_static, ros::Subscriber* subscriber);

  TransformStore store_;
  mutable std::mutex mutex_;
  std::string last_refusal_;      ///< guarded by mutex_
  double last_refused_at_ = 0.0;  ///< steady [s], guarded by mutex_
  double last_told_ = 0.0;        ///< steady [s], of the executor's thread
  std::uint64_t refused_ = 0;     ///< guarded by mutex_
  Executor executor_{
      ExecutorOptions{"the executor of /tf"}};  // before what is bound to its queue; stopped in the destructor
  ros::NodeHandle nh_;
  ros::Subscriber moving_, fixed_;
  Periodic tidying_;
};

}  // namespace external_command
