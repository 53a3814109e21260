// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/near_ids.h"

#include "external_command/core/nearest_words.h"

namespace external_command {

namespace {

template <class Objects, class Id>
std::string nearIds(const std::string& id, const Objects& objects, const Id& idOf) {
  NearestWords nearest(id);
  for (const auto& object : objects) nearest.offer(idOf(object));
  return nearest.question();
}

}  // namespace

std::string nearLaneIds(const HdMap& map, const std::string& id) {
  return nearIds(id, map.lanes(), [](const Lane& lane) -> const std::string& { return lane.id; });
}

std::string nearRoadIds(const HdMap& map, const std::string& id) {
  return nearIds(id, map.lanes(), [](const Lane& lane) -> const std::string& { return lane.road_id; });
}

std::string nearParkingSpaceIds(const HdMap& map, const std::string& id) {
  return nearIds(id, map.parkingSpaces(), [](const ParkingSpace& space) -> const std::string& { return space.id; });
}

std::string nearAreaIds(const HdMap& map, const std::string& id) {
  return nearIds(id, map.areas(), [](const Area& area) -> const std::string& { return area.id; });
}

}  // namespace external_command
