// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QCheckBox>
#include <QComboBox>
#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>

#include "panel_model.h"

namespace external_command {

/// Puts a motion command together, and sends or tries it. Shows only what the chosen command takes.
class CommandForm : public QGroupBox {
  Q_OBJECT
 public:
  /// @param model  must live as long as this.
  CommandForm(PanelModel* model, QWidget* parent = nullptr);

 private:
  QWidget* goalRow();
  QWidget* objectRow();
  QWidget* pointsRow();
  QWidget* zoneRow();
  QWidget* lastRow();
  void connectFields();
  void editGoal();
  void showDraft();
  void showObjects();

  PanelModel& model_;
  QComboBox* const kind_;
  QDoubleSpinBox *const x_, *const y_, *const heading_;
  QCheckBox* const has_heading_;
  QCheckBox* const is_nose_in_;
  QComboBox* const object_;
  QLabel* const points_;
  QDoubleSpinBox* const swath_width_;
  QCheckBox* const is_resumed_;
  QDoubleSpinBox* const target_speed_;
  QLabel* const hint_;
  QPushButton *const dry_run_, *const send_;
  QWidget *goal_row_, *object_row_, *points_row_, *zone_row_;
  bool is_showing_ = false;  ///< the fields follow the draft; their changes are no edits
};

}  // namespace external_command
