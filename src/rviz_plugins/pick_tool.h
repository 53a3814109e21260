// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rviz/tool.h>

namespace external_command {

/// Gives the panel a place of the map: click on a parking space, an area, a point of the way. The tool stays in use.
class PickTool : public rviz::Tool {
  Q_OBJECT
 public:
  PickTool();

  void onInitialize() override;
  void activate() override;
  void deactivate() override {}
  int processMouseEvent(rviz::ViewportMouseEvent& event) override;
};

}  // namespace external_command
