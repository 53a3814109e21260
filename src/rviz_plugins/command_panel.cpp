// SPDX-License-Identifier: Apache-2.0
#include "command_panel.h"

#include <ros/this_node.h>
#include <rviz/visualization_manager.h>

#include <QApplication>
#include <QEvent>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QScrollArea>
#include <QShortcut>
#include <QVBoxLayout>
#include <functional>
#include <pluginlib/class_list_macros.hpp>

#include "answers_view.h"
#include "command_form.h"
#include "readiness_view.h"
#include "running_view.h"
#include "stop_bar.h"
#include "tool_hub.h"
#include "view_watch.h"

namespace external_command {

namespace {

constexpr int kMinimumWidth = 300;  // [pixels]

}  // namespace

CommandPanel::CommandPanel(QWidget* parent) : rviz::Panel(parent), vehicle_(new QComboBox), connection_(new QLabel) {
  auto* const inner = new QWidget;
  auto* const scrolled = new QVBoxLayout(inner);
  scrolled->setContentsMargins(0, 0, 4, 0);
  scrolled->setSpacing(4);
  scrolled->addWidget(new RunningView(&model_));
  scrolled->addWidget(new CommandForm(&model_));
  scrolled->addWidget(new AnswersView(&model_), 1);
  scrolled->addWidget(new ReadinessView(&model_));
  auto* const area = new QScrollArea;
  area->setWidget(inner);
  area->setWidgetResizable(true);
  area->setFrameShape(QFrame::NoFrame);
  area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  area->setMinimumWidth(kMinimumWidth);

  auto* const layout = new QVBoxLayout(this);
  layout->setContentsMargins(6, 6, 2, 6);
  layout->setSpacing(4);
  layout->addWidget(vehicleRow());
  layout->addWidget(new StopBar(&model_));  // outside of what scrolls: always to be seen
  layout->addWidget(area, 1);

  for (QWidget* widget : findChildren<QWidget*>()) widget->installEventFilter(this);
  connect(&model_.gateway(), &GatewayLink::stateChanged, this, &CommandPanel::showConnection);
  connect(&model_.gateway(), &GatewayLink::vehiclesFound, this, &CommandPanel::showVehicles);
  connectTools();
  connectKeys();
  chooseVehicle(QString::fromStdString(ros::this_node::getNamespace()));
}

QWidget* CommandPanel::vehicleRow() {
  vehicle_->setObjectName("vehicle");
  vehicle_->setEditable(true);
  vehicle_->setInsertPolicy(QComboBox::NoInsert);
  vehicle_->setToolTip("The namespace of the vehicle; gateways that run are in the list");
  connection_->setObjectName("connection");
  auto* const made = new QWidget;
  auto* const layout = new QHBoxLayout(made);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(new QLabel("Vehicle"));
  layout->addWidget(vehicle_, 1);
  layout->addWidget(connection_);
  connect(vehicle_, QOverload<int>::of(&QComboBox::activated), this,
          [this] { chooseVehicle(vehicle_->currentText()); });
  connect(vehicle_->lineEdit(), &QLineEdit::editingFinished, this, [this] { chooseVehicle(vehicle_->currentText()); });
  return made;
}

void CommandPanel::connectTools() {
  ToolHub& hub = ToolHub::instance();
  connect(&hub, &ToolHub::goalDragged, this, [this, &hub](double x, double y, double heading) {
    if (hub.isFavoured(this)) model_.takeGoal(x, y, heading);
  });
  connect(&hub, &ToolHub::pointClicked, this, [this, &hub](double x, double y) {
    if (hub.isFavoured(this)) model_.takePoint(x, y);
  });
  connect(&hub, &ToolHub::stopPressed, this, [this] { model_.gateway().stop(); });
  connect(&hub, &ToolHub::sendPressed, this, [this, &hub](bool is_dry_run) {
    if (hub.isFavoured(this)) model_.send(is_dry_run);
  });
  connect(&hub, &ToolHub::kindPressed, this, [this, &hub](int number) {
    if (hub.isFavoured(this)) model_.edit([number](CommandDraft& draft) { draft.kind = kCommandKinds[number].kind; });
  });
}

void CommandPanel::connectKeys() {
  ToolHub& hub = ToolHub::instance();
  const auto bind = [this, &hub](const QKeySequence& keys, const std::function<void()>& tell) {
    auto* const shortcut = new QShortcut(keys, this);
    shortcut->setContext(Qt::ApplicationShortcut);
    shortcut->setAutoRepeat(false);
    // With several panels Qt finds the key ambiguous, and tells one of them: whichever it is tells the hub.
    connect(shortcut, &QShortcut::activated, &hub, tell);
    connect(shortcut, &QShortcut::activatedAmbiguously, &hub, tell);
  };
  bind(Qt::Key_Space, [&hub] { Q_EMIT hub.stopPressed(); });
  bind(Qt::CTRL | Qt::Key_Return, [&hub] { Q_EMIT hub.sendPressed(false); });
  bind(Qt::CTRL | Qt::SHIFT | Qt::Key_Return, [&hub] { Q_EMIT hub.sendPressed(true); });
  for (int i = 0; i < static_cast<int>(kCommandKinds.size()); ++i) {
    bind(Qt::Key_F1 + i, [&hub, i] { Q_EMIT hub.kindPressed(i); });
  }
}

void CommandPanel::onInitialize() {
  new ViewWatch(
      vis_manager_, [this](double x, double y) { model_.gateway().lookAt(x, y); }, this);
}

void CommandPanel::chooseVehicle(const QString& vehicle) {
  const std::string before = model_.gateway().vehicle();
  if (vehicle.isEmpty()) return;
  model_.connectTo(vehicle.toStdString());
  vehicle_->setEditText(vehicle);
  if (model_.gateway().vehicle() != before) Q_EMIT configChanged();
}

void CommandPanel::showVehicles(const std::vector<std::string>& vehicles) {
  const QString present = vehicle_->currentText();
  vehicle_->clear();
  for (const std::string& vehicle : vehicles) vehicle_->addItem(QString::fromStdString(vehicle));
  vehicle_->setEditText(present);
}

void CommandPanel::showConnection() {
  const bool is_found = model_.gateway().state().is_found;
  connection_->setText(is_found ? "<span style='color:#2e7d32'>&#9679; online</span>"
                                : "<span style='color:#c62828'>&#9679; no gateway</span>");
}

/// Who uses a panel wants what the tools pick in it.
bool CommandPanel::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonPress || event->type() == QEvent::FocusIn) {
    ToolHub::instance().favour(this);
    if (watched == vehicle_) model_.gateway().findVehicles();
  }
  return rviz::Panel::eventFilter(watched, event);
}

void CommandPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  QString vehicle;
  if (config.mapGetString("Vehicle", &vehicle)) chooseVehicle(vehicle);
  QString kind;
  if (!config.mapGetString("Command", &kind)) return;
  for (const CommandKindWords& known : kCommandKinds) {
    if (kind == known.name) model_.edit([&](CommandDraft& draft) { draft.kind = known.kind; });
  }
}

void CommandPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Vehicle", QString::fromStdString(model_.gateway().vehicle()));
  config.mapSetValue("Command", kCommandKinds[static_cast<std::size_t>(model_.draft().kind)].name);
}

}  // namespace external_command

PLUGINLIB_EXPORT_CLASS(external_command::CommandPanel, rviz::Panel)
