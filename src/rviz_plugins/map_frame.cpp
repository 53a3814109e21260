// SPDX-License-Identifier: Apache-2.0
#include "map_frame.h"

#include <OgreQuaternion.h>
#include <ros/time.h>
#include <rviz/frame_manager.h>

#include <cmath>

namespace external_command {

std::optional<MapPlace> toMapFrame(rviz::DisplayContext& context, const Ogre::Vector3& position, double heading) {
  Ogre::Vector3 origin = Ogre::Vector3::ZERO;
  Ogre::Quaternion rotation = Ogre::Quaternion::IDENTITY;
  if (context.getFixedFrame() != "map" &&
      !context.getFrameManager()->getTransform("map", ros::Time(), origin, rotation)) {
    return std::nullopt;
  }
  const Ogre::Vector3 place = rotation.Inverse() * (position - origin);
  const Ogre::Vector3 ahead = rotation.Inverse() * Ogre::Vector3(static_cast<float>(std::cos(heading)),
                                                                 static_cast<float>(std::sin(heading)), 0.0F);
  return MapPlace{place.x, place.y, std::atan2(ahead.y, ahead.x)};
}

}  // namespace external_command
