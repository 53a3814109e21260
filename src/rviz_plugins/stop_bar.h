// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>

#include "panel_model.h"

namespace external_command {

/// STOP, START, clear; auto and manual with the mode that the chassis reports.
class StopBar : public QWidget {
  Q_OBJECT
 public:
  /// @param model  must live as long as this.
  StopBar(PanelModel* model, QWidget* parent = nullptr);

 private:
  void showState();

  PanelModel& model_;
  QLabel* const mode_;
  QPushButton* const auto_;
  QPushButton* const manual_;
};

}  // namespace external_command
