// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QPointer>

namespace external_command {

/// Through which tools and keys reach the panels of this rviz. With several panels (one for each vehicle) the one that
/// was used last gets what the tools pick, and the keys. In the thread of rviz's windows.
class ToolHub : public QObject {
  Q_OBJECT
 public:
  static ToolHub& instance();

  /// From now on `panel` gets what is picked.
  void favour(QObject* panel);

  /// Does `panel` get it? The first that asks does where none was used yet.
  bool isFavoured(QObject* panel);

 Q_SIGNALS:
  /// In the frame of the map [m, rad].
  void goalDragged(double x, double y, double heading);
  void pointClicked(double x, double y);

  /// A key was pressed. STOP is for every panel.
  void stopPressed();
  void sendPressed(bool is_dry_run);
  void kindPressed(int number);  ///< of a CommandKind

  /// Another panel gets what is picked.
  void favourChanged();

 private:
  ToolHub() = default;

  QPointer<QObject> favoured_;
};

}  // namespace external_command
