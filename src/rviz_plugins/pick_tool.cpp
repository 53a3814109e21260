// SPDX-License-Identifier: Apache-2.0
#include "pick_tool.h"

#include <OgrePlane.h>
#include <rviz/display_context.h>
#include <rviz/geometry.h>
#include <rviz/load_resource.h>
#include <rviz/viewport_mouse_event.h>

#include <pluginlib/class_list_macros.hpp>

#include "map_frame.h"
#include "tool_hub.h"

namespace external_command {

PickTool::PickTool() { shortcut_key_ = 'k'; }

void PickTool::onInitialize() {
  setName("Pick");
  setCursor(QCursor(Qt::CrossCursor));
}

void PickTool::activate() {
  setStatus("Click on a parking space, an area, or a point of the way: what the command takes.");
}

int PickTool::processMouseEvent(rviz::ViewportMouseEvent& event) {
  if (!event.leftDown()) return 0;
  Ogre::Plane ground(Ogre::Vector3::UNIT_Z, 0.0F);
  Ogre::Vector3 point;
  if (!rviz::getPointOnPlaneFromWindowXY(event.viewport, ground, event.x, event.y, point)) {
    setStatus("There is no ground behind this.");
    return 0;
  }
  const auto place = toMapFrame(*context_, point, 0.0);
  if (!place) {
    setStatus("The frame map is not known: there is no transform to it.");
    return 0;
  }
  Q_EMIT ToolHub::instance().pointClicked(place->x, place->y);
  return Render;
}

}  // namespace external_command

PLUGINLIB_EXPORT_CLASS(external_command::PickTool, rviz::Tool)
