// SPDX-License-Identifier: Apache-2.0
#include "destination_tool.h"

#include <pluginlib/class_list_macros.hpp>

#include "map_frame.h"
#include "tool_hub.h"

namespace external_command {

DestinationTool::DestinationTool() { shortcut_key_ = 'd'; }

void DestinationTool::onInitialize() {
  rviz::PoseTool::onInitialize();
  setName("Destination");
}

void DestinationTool::onPoseSet(double x, double y, double theta) {
  const auto place = toMapFrame(*context_, Ogre::Vector3(static_cast<float>(x), static_cast<float>(y), 0.0F), theta);
  if (!place) return setStatus("The frame map is not known: there is no transform to it.");
  Q_EMIT ToolHub::instance().goalDragged(place->x, place->y, place->heading);
}

}  // namespace external_command

PLUGINLIB_EXPORT_CLASS(external_command::DestinationTool, rviz::Tool)
