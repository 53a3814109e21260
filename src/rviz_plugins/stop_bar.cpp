// SPDX-License-Identifier: Apache-2.0
#include "stop_bar.h"

#include <QGridLayout>

#include "external_command/ActionCommand.h"
#include "words.h"

namespace external_command {

namespace {

const char* const kStopStyle =
    "QPushButton { background: #c81414; color: white; font-weight: bold; font-size: 26px; border-radius: 6px;"
    " border: 2px solid #8c0c0c; padding: 10px; }"
    "QPushButton:hover { background: #e02020; } QPushButton:pressed { background: #8c0c0c; }";
const char* const kPresentMode = "QPushButton { background: #2e7d32; color: white; font-weight: bold; }";

QPushButton* button(const QString& text, const QString& name, const QString& hint) {
  auto* const made = new QPushButton(text);
  made->setObjectName(name);
  made->setToolTip(hint);
  return made;
}

}  // namespace

StopBar::StopBar(PanelModel* model, QWidget* parent)
    : QWidget(parent),
      model_(*model),
      mode_(new QLabel),
      auto_(button("Auto", "auto", "Hand the vehicle over to the stack (SWITCH_TO_AUTO)")),
      manual_(button("Manual", "manual", "Take the vehicle from the stack (SWITCH_TO_MANUAL)")) {
  auto* const stop = button("STOP", "stop", "Stop the vehicle at once. Key: Space, wherever the mouse is in rviz");
  stop->setStyleSheet(kStopStyle);
  stop->setMinimumHeight(64);
  stop->setFocusPolicy(Qt::NoFocus);
  auto* const start = button("Start", "start", "Go on after a stop (START)");
  auto* const clear = button("Clear", "clear", "End the command that is driven or planned (CLEAR_PLANNING)");
  mode_->setObjectName("mode");
  mode_->setAlignment(Qt::AlignCenter);

  auto* const layout = new QGridLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(stop, 0, 0, 1, 4);
  layout->addWidget(start, 1, 0, 1, 2);
  layout->addWidget(clear, 1, 2, 1, 2);
  layout->addWidget(auto_, 2, 0);
  layout->addWidget(manual_, 2, 1);
  layout->addWidget(mode_, 2, 2, 1, 2);

  connect(stop, &QPushButton::pressed, this, [this] { model_.gateway().stop(); });
  const auto acts = [this](QPushButton* pressed, std::uint8_t action) {
    connect(pressed, &QPushButton::clicked, this, [this, action] { model_.gateway().act(action); });
  };
  acts(start, ActionCommand::START);
  acts(clear, ActionCommand::CLEAR_PLANNING);
  acts(auto_, ActionCommand::SWITCH_TO_AUTO);
  acts(manual_, ActionCommand::SWITCH_TO_MANUAL);
  connect(&model_.gateway(), &GatewayLink::stateChanged, this, &StopBar::showState);
  showState();
}

void StopBar::showState() {
  const std::optional<Chassis>& chassis = model_.gateway().state().chassis;
  const bool is_auto = chassis && chassis->driving_mode == Chassis::COMPLETE_AUTO_DRIVE;
  const bool is_manual = chassis && chassis->driving_mode == Chassis::COMPLETE_MANUAL;
  auto_->setStyleSheet(is_auto ? kPresentMode : "");
  manual_->setStyleSheet(is_manual ? kPresentMode : "");
  mode_->setText(chassis
                     ? QString("<b>%1</b>, %2").arg(modeWords(chassis->driving_mode), speedWords(chassis->speed_mps))
                     : "<span style='color:#c62828'>no chassis report</span>");
}

}  // namespace external_command
