// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rviz/display_context.h>

#if __has_include(<OgreVector.h>)
#include <OgreVector.h>
#else  // Ogre before 1.12
#include <OgreVector3.h>
#endif

#include <optional>

namespace external_command {

/// A place on the ground, in the frame `map` [m, rad].
struct MapPlace {
  double x = 0.0, y = 0.0, heading = 0.0;
};

/// @param position  in rviz's fixed frame.
/// @param heading   about its z axis.
/// @return nullopt: rviz knows no transform to `map`.
std::optional<MapPlace> toMapFrame(rviz::DisplayContext& context, const Ogre::Vector3& position, double heading);

}  // namespace external_command
