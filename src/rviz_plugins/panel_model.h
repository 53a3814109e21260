// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <deque>
#include <string>
#include <vector>

#include "command_draft.h"
#include "gateway_link.h"

namespace external_command {

/// What the panel shows and does, without its widgets: the gateway, the command that is being put together, and the
/// last answers. All in the thread of rviz's windows.
class PanelModel : public QObject {
  Q_OBJECT
 public:
  explicit PanelModel(QObject* parent = nullptr);

  GatewayLink& gateway() { return gateway_; }
  const GatewayLink& gateway() const { return gateway_; }
  const CommandDraft& draft() const { return draft_; }

  /// Parking spaces or areas, what the draft needs, in the order of their ids.
  const std::vector<MapObject>& objects() const { return objects_; }

  /// The newest first.
  const std::deque<Answer>& answers() const { return answers_; }

  /// Its namespace; the lists of the map are asked for anew.
  void connectTo(const std::string& vehicle);

  /// Calls `edit` with the draft, and tells and shows what has changed.
  template <class Edit>
  void edit(const Edit& edit) {
    edit(draft_);
    noteEdit();
  }

  void refreshObjects();
  void send(bool is_dry_run);
  void setSpeed(double target_speed);  ///< of the running command [m/s]

  /// From the tools, in the frame of the map [m, rad].
  void takeGoal(double x, double y, double heading);
  void takePoint(double x, double y);

 Q_SIGNALS:
  void draftChanged();
  void objectsChanged();
  void answersChanged();

 private:
  void noteEdit();
  void showDraft();
  void takeAnswer(const Answer& answer);
  void takeObjects(const FindMapObjects::Request& wanted, const FindMapObjects::Response& found);
  void choose(const FindMapObjects::Request& wanted, const FindMapObjects::Response& found);
  void say(const QString& what, const QString& words);

  GatewayLink gateway_;
  CommandDraft draft_;
  CommandKind listed_for_ = CommandKind::kLaneFollow;
  std::vector<MapObject> objects_;
  PlannedPath planned_;  ///< of the last dry run
  std::deque<Answer> answers_;
  bool was_found_ = false;
};

}  // namespace external_command
