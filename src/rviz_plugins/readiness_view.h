// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QGroupBox>
#include <QLabel>

#include "panel_model.h"

namespace external_command {

/// What the gateway has, and what it lacks.
class ReadinessView : public QGroupBox {
  Q_OBJECT
 public:
  /// @param model  must live as long as this.
  ReadinessView(PanelModel* model, QWidget* parent = nullptr);

 private:
  void showState();

  PanelModel& model_;
  QLabel* const words_;
};

/// In words for a person, as HTML.
QString readinessWords(const GatewayState& state);

}  // namespace external_command
