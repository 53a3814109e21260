// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QTimer>
#include <functional>

#include "map_frame.h"

namespace external_command {

/// Tells, at most once a second, where the middle of rviz's view has come to, so that the gateway can draw a large map
/// there.
class ViewWatch : public QObject {
 public:
  /// @param context  must live as long as this.
  ViewWatch(rviz::DisplayContext* context, std::function<void(double x, double y)> tell, QObject* parent);

 private:
  void look();

  rviz::DisplayContext* const context_;
  const std::function<void(double x, double y)> tell_;
  std::optional<MapPlace> told_;
  QTimer timer_;
};

}  // namespace external_command
