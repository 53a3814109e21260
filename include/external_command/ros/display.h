// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <geometry_msgs/PointStamped.h>
#include <ros/node_handle.h>

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "external_command/ros/executor.h"
#include "external_command/ros/map_part.h"
#include "external_command/ros/markers.h"
#include "external_command/ros/parameters.h"

namespace external_command {

/// `is_advertised`: what came of advertising `topic` with `type`.
/// @throws InternalError  it is not; the text names topic and type.
void requireAdvertised(bool is_advertised, const std::string& topic, const std::string& type);

struct DisplayParams {
  std::string markers_topic = "external_command/markers";
  std::string map_ids_topic = "external_command/map_ids";
  std::string look_at_topic = "external_command/look_at";
  std::string map_frame;
  std::string base_frame;
  VehicleParams vehicle;
  MapPartParams map;
  std::size_t max_ids = 300;  ///< of lanes, of parking spaces, and of areas: the nearest
  RequestLimits requests;
};

/// Names of topics, and how much is drawn.
/// @throws InvalidParameter
DisplayParams readDisplayParams(const ParameterReader& reader);

/// Shows map and commands in rviz, on a thread of its own and at most 20 times a second: drawing never delays an
/// answer, and of commands that follow one another faster only the newest is drawn. Thread-safe.
/// A small map goes to each subscriber once, when it connects; after that only what a command changes is sent. Of a
/// large map what is near the vehicle goes to all, and again when the vehicle has come further. Ids have a topic of
/// their own, so that they cost nothing where nobody looks at them; there they are sent again and again, since rviz
/// forgets what comes while a namespace is switched off.
class Display {
 public:
  using Whereabouts = std::function<std::optional<Point2d>()>;

  /// @param map      may be nullptr.
  /// @param vehicle  tells where the vehicle is; nullopt: not known.
  /// @throws InternalError  a topic is published with another type in this process.
  Display(ros::NodeHandle nh, const DisplayParams& params, std::shared_ptr<const HdMap> map, Whereabouts vehicle);
  ~Display() { executor_.stop(); }

  /// Draws `scene` in place of the last command's.
  void show(CommandScene scene);

  /// Draws `scene` of a command that was refused.
  void showRefused(CommandScene scene);

 private:
  /// A part of the map that goes to a topic of its own.
  struct View {
    std::optional<MapPartChooser> chooser;  ///< nullopt: there is no map
    ros::Publisher publisher;
  };

  void drawNewest();
  void drawMap();
  void drawIds();
  visualization_msgs::MarkerArray wholeScene();
  visualization_msgs::MarkerArray ids();
  void lookAt(const geometry_msgs::PointStamped& place);

  const DisplayParams params_;
  const std::shared_ptr<const HdMap> map_;
  const Whereabouts vehicle_;
  Executor executor_;   // before what is bound to its queue
  ros::NodeHandle nh_;  ///< on that queue
  View scene_, ids_;
  visualization_msgs::MarkerArray command_;  ///< as it was drawn last
  ros::Subscriber look_at_subscriber_;
  std::mutex mutex_;
  std::optional<CommandScene> sent_, refused_;  ///< still to be drawn
  std::atomic<bool> has_news_{false};           ///< one of these
  Periodic command_timer_, map_timer_, ids_timer_;
};

}  // namespace external_command
