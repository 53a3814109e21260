// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rviz/default_plugin/tools/pose_tool.h>

namespace external_command {

/// Gives the panel the goal of a command: press where the vehicle is to stand, drag to where it is to point.
class DestinationTool : public rviz::PoseTool {
  Q_OBJECT
 public:
  DestinationTool();

  void onInitialize() override;

 protected:
  void onPoseSet(double x, double y, double theta) override;
};

}  // namespace external_command
