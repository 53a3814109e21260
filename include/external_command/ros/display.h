// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/node_handle.h>

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "external_command/ros/dedicated_lane.h"
#include "external_command/ros/markers.h"

namespace external_command {

/// `is_advertised`: what came of advertising `topic` with `type`.
/// @throws InternalError  it is not; the text names topic and type.
void requireAdvertised(bool is_advertised, const std::string& topic, const std::string& type);

struct DisplayParams {
  std::string markers_topic;
  std::string map_frame;
  std::string base_frame;
  VehicleParams vehicle;
};

/// Shows map and commands in rviz, on a thread of its own and at most 20 times a second: drawing never delays an
/// answer, and of commands that follow one another faster only the newest is drawn. Thread-safe. The map goes to each
/// subscriber once, when it connects; after that only what a command changes is sent.
class Display {
 public:
  /// @param map  may be nullptr.
  /// @throws InternalError  a topic is published with another type in this process.
  Display(ros::NodeHandle nh, const DisplayParams& params, std::shared_ptr<const HdMap> map);
  ~Display() { lane_.stop(); }

  /// Draws `scene` in place of the last command's.
  void show(CommandScene scene);

  /// Draws `scene` of a command that was refused.
  void showRefused(CommandScene scene);

 private:
  void drawNewest();
  void greet(const ros::SingleSubscriberPublisher& subscriber) const;

  const DisplayParams params_;
  const std::shared_ptr<const HdMap> map_;
  DedicatedLane lane_;  // before the publisher that is bound to its queue
  ros::Publisher markers_publisher_;
  std::mutex mutex_;
  std::optional<CommandScene> sent_, refused_;  ///< still to be drawn
  ros::SteadyTimer timer_;
};

}  // namespace external_command
