// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <rviz/panel.h>

#include <QComboBox>
#include <QLabel>

#include "panel_model.h"

namespace external_command {

/// rviz's panel for one vehicle: stop it, see what it does, send it commands. What the tools pick goes to the panel
/// that was used last.
class CommandPanel : public rviz::Panel {
  Q_OBJECT
 public:
  explicit CommandPanel(QWidget* parent = nullptr);

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

  PanelModel& model() { return model_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  QWidget* vehicleRow();
  void connectTools();
  void connectKeys();
  void chooseVehicle(const QString& vehicle);
  void showVehicles(const std::vector<std::string>& vehicles);
  void showConnection();

  PanelModel model_;
  QComboBox* const vehicle_;
  QLabel* const connection_;
};

}  // namespace external_command
