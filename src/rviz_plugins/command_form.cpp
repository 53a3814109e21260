// SPDX-License-Identifier: Apache-2.0
#include "command_form.h"

#include <QCompleter>
#include <QGridLayout>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

namespace external_command {

namespace {

constexpr double kDegree = M_PI / 180.0;
constexpr double kFarthest = 1e7;  // coordinates [m]

QDoubleSpinBox* number(const QString& name, double low, double high, double step, const QString& suffix) {
  auto* const made = new QDoubleSpinBox;
  made->setObjectName(name);
  made->setRange(low, high);
  made->setSingleStep(step);
  made->setDecimals(2);
  made->setSuffix(suffix);
  made->setKeyboardTracking(false);
  made->setMinimumWidth(70);
  return made;
}

template <class Widget>
Widget* named(const QString& name, Widget* widget) {
  widget->setObjectName(name);
  return widget;
}

/// A row of widgets without margins.
QWidget* row(std::initializer_list<QWidget*> widgets, int stretched) {
  auto* const made = new QWidget;
  auto* const layout = new QHBoxLayout(made);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  int index = 0;
  for (QWidget* widget : widgets) layout->addWidget(widget, index++ == stretched ? 1 : 0);
  return made;
}

}  // namespace

CommandForm::CommandForm(PanelModel* model, QWidget* parent)
    : QGroupBox("New command", parent),
      model_(*model),
      kind_(named("kind", new QComboBox)),
      x_(number("x", -kFarthest, kFarthest, 1.0, " m")),
      y_(number("y", -kFarthest, kFarthest, 1.0, " m")),
      heading_(number("heading", -360.0, 360.0, 5.0, QString::fromUtf8("°"))),
      has_heading_(named("has_heading", new QCheckBox("heading"))),
      is_nose_in_(named("nose_in", new QCheckBox("nose in"))),
      object_(named("object", new QComboBox)),
      points_(named("points", new QLabel)),
      swath_width_(number("swath_width", 0.0, 100.0, 0.1, " m")),
      is_resumed_(named("resume", new QCheckBox("resume"))),
      target_speed_(number("target_speed", 0.0, 50.0, 0.5, " m/s")),
      hint_(named("hint", new QLabel)),
      dry_run_(named("dry_run", new QPushButton("Dry run"))),
      send_(named("send", new QPushButton("Send"))) {
  for (const CommandKindWords& known : kCommandKinds) kind_->addItem(known.words);
  kind_->setToolTip("The command; keys F1 ... F6");
  hint_->setWordWrap(true);
  hint_->setStyleSheet("color: #6d4c00;");
  auto* const layout = new QVBoxLayout(this);
  layout->setSpacing(4);
  layout->addWidget(kind_);
  layout->addWidget(goal_row_ = goalRow());
  layout->addWidget(object_row_ = objectRow());
  layout->addWidget(points_row_ = pointsRow());
  layout->addWidget(zone_row_ = zoneRow());
  layout->addWidget(lastRow());
  layout->addWidget(hint_);
  connectFields();
  showObjects();
  showDraft();
}

QWidget* CommandForm::goalRow() {
  auto* const made = new QWidget;
  auto* const layout = new QGridLayout(made);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->setSpacing(4);
  layout->addWidget(new QLabel("x"), 0, 0);
  layout->addWidget(x_, 0, 1);
  layout->addWidget(new QLabel("y"), 0, 2);
  layout->addWidget(y_, 0, 3);
  layout->addWidget(has_heading_, 1, 0, 1, 2);
  layout->addWidget(heading_, 1, 3);
  layout->addWidget(is_nose_in_, 2, 0, 1, 4);
  layout->setColumnStretch(1, 1);
  layout->setColumnStretch(3, 1);
  is_nose_in_->setToolTip("Park nose in; else nose out, reversing in");
  return made;
}

QWidget* CommandForm::objectRow() {
  object_->setEditable(true);
  object_->setInsertPolicy(QComboBox::NoInsert);
  object_->completer()->setCompletionMode(QCompleter::PopupCompletion);
  object_->completer()->setFilterMode(Qt::MatchContains);
  auto* const refresh = named("refresh", new QToolButton);
  refresh->setText(QString::fromUtf8("↻"));
  refresh->setToolTip("Ask the gateway again for what its map has");
  connect(refresh, &QToolButton::clicked, &model_, &PanelModel::refreshObjects);
  return row({object_, refresh}, 0);
}

QWidget* CommandForm::pointsRow() {
  auto* const undo = named("undo_point", new QPushButton("Undo"));
  auto* const clear = named("clear_points", new QPushButton("Clear"));
  connect(undo, &QPushButton::clicked, this, [this] {
    model_.edit([](CommandDraft& draft) {
      if (!draft.points.empty()) draft.points.pop_back();
    });
  });
  connect(clear, &QPushButton::clicked, this,
          [this] { model_.edit([](CommandDraft& draft) { draft.points.clear(); }); });
  return row({points_, undo, clear}, 0);
}

QWidget* CommandForm::zoneRow() {
  swath_width_->setSpecialValueText("as configured");
  is_resumed_->setToolTip("Go on where an earlier run of this area stopped");
  return row({new QLabel("swath"), swath_width_, is_resumed_}, 1);
}

QWidget* CommandForm::lastRow() {
  target_speed_->setSpecialValueText("any speed");
  target_speed_->setToolTip("The speed to drive at; \"any speed\": what lanes and bends allow");
  dry_run_->setToolTip("Plan and show the path; the vehicle stays as it is. Keys: Ctrl+Shift+Return");
  send_->setToolTip("Keys: Ctrl+Return");
  send_->setStyleSheet("QPushButton { font-weight: bold; }");
  return row({target_speed_, dry_run_, send_}, 0);
}

void CommandForm::connectFields() {
  const auto edits = [this](auto change) {
    return [this, change] {
      if (!is_showing_) model_.edit(change);
    };
  };
  const auto changed = QOverload<double>::of(&QDoubleSpinBox::valueChanged);
  connect(kind_, QOverload<int>::of(&QComboBox::currentIndexChanged), this,
          edits([this](CommandDraft& draft) { draft.kind = static_cast<CommandKind>(kind_->currentIndex()); }));
  for (QDoubleSpinBox* field : {x_, y_, heading_}) connect(field, changed, this, &CommandForm::editGoal);
  connect(has_heading_, &QCheckBox::toggled, this, &CommandForm::editGoal);
  connect(is_nose_in_, &QCheckBox::toggled, this,
          edits([this](CommandDraft& draft) { draft.is_nose_in = is_nose_in_->isChecked(); }));
  connect(object_, &QComboBox::currentTextChanged, this,
          edits([this](CommandDraft& draft) { draft.object_id = object_->currentText().trimmed().toStdString(); }));
  connect(swath_width_, changed, this,
          edits([this](CommandDraft& draft) { draft.swath_width = swath_width_->value(); }));
  connect(is_resumed_, &QCheckBox::toggled, this,
          edits([this](CommandDraft& draft) { draft.is_resumed = is_resumed_->isChecked(); }));
  connect(target_speed_, changed, this,
          edits([this](CommandDraft& draft) { draft.target_speed = target_speed_->value(); }));
  connect(dry_run_, &QPushButton::clicked, this, [this] { model_.send(true); });
  connect(send_, &QPushButton::clicked, this, [this] { model_.send(false); });
  connect(&model_, &PanelModel::draftChanged, this, &CommandForm::showDraft);
  connect(&model_, &PanelModel::objectsChanged, this, &CommandForm::showObjects);
}

void CommandForm::editGoal() {
  if (is_showing_) return;
  model_.edit([this](CommandDraft& draft) {
    if (!draft.goal) draft.goal.emplace();
    draft.goal->x = x_->value();
    draft.goal->y = y_->value();
    draft.goal->heading = kDegree * heading_->value();
    draft.goal->has_heading = has_heading_->isChecked();
  });
}

void CommandForm::showDraft() {
  const CommandDraft& draft = model_.draft();
  is_showing_ = true;
  kind_->setCurrentIndex(static_cast<int>(draft.kind));
  const Pose goal = draft.goal.value_or(Pose());
  x_->setValue(goal.x);
  y_->setValue(goal.y);
  heading_->setValue(goal.heading / kDegree);
  has_heading_->setChecked(goal.has_heading);
  heading_->setEnabled(goal.has_heading || draft.needsHeading());
  is_nose_in_->setChecked(draft.is_nose_in);
  object_->setCurrentText(QString::fromStdString(draft.object_id));
  const char* const word = draft.kind == CommandKind::kPathFollow ? "points" : "way points";
  points_->setText(QString("%1 %2").arg(draft.points.size()).arg(word));
  swath_width_->setValue(draft.swath_width);
  is_resumed_->setChecked(draft.is_resumed);
  target_speed_->setValue(draft.target_speed);
  goal_row_->setVisible(draft.needsGoal());
  is_nose_in_->setVisible(draft.kind == CommandKind::kPreciseParking);
  object_row_->setVisible(draft.objectKind() != 0);
  points_row_->setVisible(draft.takesPoints());
  zone_row_->setVisible(draft.kind == CommandKind::kZoneCover);
  const QString missing = draft.missing();
  hint_->setText(missing);
  hint_->setVisible(!missing.isEmpty());
  is_showing_ = false;
}

void CommandForm::showObjects() {
  is_showing_ = true;
  object_->clear();
  for (const MapObject& object : model_.objects()) object_->addItem(QString::fromStdString(object.id));
  object_->setCurrentText(QString::fromStdString(model_.draft().object_id));
  is_showing_ = false;
}

}  // namespace external_command
