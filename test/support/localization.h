// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <tf2_msgs/TFMessage.h>

#include <chrono>
#include <thread>

#include "blocking_nodelets.h"
#include "comes_true.h"

namespace external_command {

/// A localization that tells where the test wants the vehicle to be.
class Localization {
 public:
  Localization() { publisher_ = ros::NodeHandle().advertise<tf2_msgs::TFMessage>("/tf", 10); }

  /// Returns once `planner` sees the vehicle there.
  void place(const BlockingPlanner& planner, double x) const {
    tf2_msgs::TFMessage message;
    message.transforms.resize(1);
    auto& transform = message.transforms[0];
    transform.header.frame_id = "map";
    transform.child_frame_id = "base_link";
    transform.transform.translation.x = x;
    transform.transform.rotation.w = 1.0;
    const auto tell = [&] {
      transform.header.stamp = ros::Time::now();
      publisher_.publish(message);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
      return planner.seesVehicleAt(x);
    };
    EXPECT_TRUE(comesTrue(tell)) << "the vehicle is not seen at x = " << x;
  }

 private:
  ros::Publisher publisher_;
};

}  // namespace external_command
