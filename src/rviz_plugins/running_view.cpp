// SPDX-License-Identifier: Apache-2.0
#include "running_view.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <QVBoxLayout>

#include "status_colors.h"
#include "words.h"

namespace external_command {

RunningView::RunningView(PanelModel* model, QWidget* parent)
    : QGroupBox("Vehicle's command", parent),
      model_(*model),
      name_(new QLabel),
      bar_(new QProgressBar),
      left_(new QLabel),
      words_(new QLabel),
      speed_(new QDoubleSpinBox) {
  name_->setObjectName("running");
  bar_->setObjectName("progress");
  bar_->setRange(0, 1000);
  left_->setObjectName("left");
  words_->setObjectName("running_words");
  words_->setWordWrap(true);
  speed_->setRange(0.0, 50.0);
  speed_->setSingleStep(0.5);
  speed_->setSuffix(" m/s");
  speed_->setSpecialValueText("as planned");
  speed_->setToolTip("The speed of the running command; \"as planned\" takes back what was set");
  auto* const set_speed = new QPushButton("Set speed");
  set_speed->setObjectName("set_speed");
  connect(set_speed, &QPushButton::clicked, this, [this] { model_.setSpeed(speed_->value()); });

  auto* const row = new QHBoxLayout;
  row->addWidget(left_, 1);
  row->addWidget(speed_);
  row->addWidget(set_speed);
  auto* const layout = new QVBoxLayout(this);
  layout->setSpacing(3);
  layout->addWidget(name_);
  layout->addWidget(bar_);
  layout->addLayout(row);
  layout->addWidget(words_);
  connect(&model_.gateway(), &GatewayLink::stateChanged, this, &RunningView::showState);
  showState();
}

void RunningView::showState() {
  const std::optional<CommandStatus>& motion = model_.gateway().state().motion;
  if (!motion) {
    name_->setText("none was sent yet");
    bar_->setValue(0);
    bar_->setFormat("");
    left_->clear();
    words_->clear();
    return;
  }
  const QString service = motion->service.empty() ? QString("command") : serviceWords(motion->service);
  name_->setText(QString("<b>%1 %2</b> <span style='color:%3'><b>%4</b></span>")
                     .arg(service)
                     .arg(motion->command_id)
                     .arg(statusColor(motion->status), statusWord(motion->status)));
  const bool is_running = motion->status == CommandStatus::RUNNING;
  if (motion->status == CommandStatus::FINISHED) {
    bar_->setValue(1000);
    bar_->setFormat("arrived");
  } else if (motion->has_progress) {
    bar_->setValue(static_cast<int>(1000.0 * motion->share_done));
    bar_->setFormat(QString("%1 %").arg(100.0 * motion->share_done, 0, 'f', 0));
  } else if (is_running) {
    bar_->setValue(0);
    bar_->setFormat("under way");
  } else {
    bar_->setFormat("ended");
  }
  left_->setText(
      is_running && motion->has_progress
          ? QString("%1 left, %2").arg(distanceWords(motion->distance_left), durationWords(motion->time_left))
          : "");
  words_->setText(QString::fromStdString(motion->message).toHtmlEscaped());
}

}  // namespace external_command
