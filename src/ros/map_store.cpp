// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/map_store.h"

#include <ros/console.h>
#include <ros/time.h>

#include <map>
#include <mutex>
#include <sstream>

#include "external_command/core/text.h"

namespace external_command {

namespace {

std::shared_ptr<const Router> load(const std::string& file, const MapOrigin& origin, const MapParams& map_params,
                                   const RouterParams& params) {
  const ros::WallTime begin = ros::WallTime::now();
  const auto map = readMap(file, origin, map_params);
  auto router = std::make_shared<const Router>(map, params);
  for (const MapWarning& warning : map->warnings()) ROS_WARN_STREAM("map " << file << ": " << warning.what);
  ROS_INFO_STREAM("map " << file << ": " << map->lanes().size() << " lanes, " << map->parkingSpaces().size()
                         << " parking spaces, " << map->areas().size() << " areas, origin " << at(map->origin())
                         << ", loaded in " << (ros::WallTime::now() - begin).toSec() << " s");
  return router;
}

std::string keyOf(const std::string& file, const MapOrigin& origin, const MapParams& map_params,
                  const RouterParams& params) {
  return text(file, "|", static_cast<int>(origin.kind), "|", origin.point.x(), "|", origin.point.y(), "|",
              map_params.max_link_gap, "|", map_params.max_segment_length, "|", params.lane_change_price, "|",
              params.min_lane_change_length, "|", params.tight_lane_change_price, "|", params.min_turning_radius, "|",
              params.stopping_error);
}

}  // namespace

std::shared_ptr<const Router> sharedRouter(const std::string& file, const MapOrigin& origin,
                                           const MapParams& map_params, const RouterParams& params) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Router>> loaded;
  const std::lock_guard<std::mutex> lock(mutex);
  auto& known = loaded[keyOf(file, origin, map_params, params)];
  auto router = known.lock();
  if (!router) known = router = load(file, origin, map_params, params);
  return router;
}

}  // namespace external_command
