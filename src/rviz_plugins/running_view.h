// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QProgressBar>

#include "panel_model.h"

namespace external_command {

/// The motion command that is driven, or was last: how far it has come, and when it will be there.
class RunningView : public QGroupBox {
  Q_OBJECT
 public:
  /// @param model  must live as long as this.
  RunningView(PanelModel* model, QWidget* parent = nullptr);

 private:
  void showState();

  PanelModel& model_;
  QLabel* const name_;
  QProgressBar* const bar_;
  QLabel* const left_;
  QLabel* const words_;
  QDoubleSpinBox* const speed_;
};

}  // namespace external_command
