// SPDX-License-Identifier: Apache-2.0
#include "readiness_view.h"

#include <QStringList>
#include <QVBoxLayout>

#include "words.h"

namespace external_command {

namespace {

QString escaped(const std::string& text) { return QString::fromStdString(text).toHtmlEscaped(); }

QString neededBy(const ReadinessCondition& condition) {
  QStringList services;
  for (const std::string& service : condition.needed_by) services << serviceWords(service).toHtmlEscaped();
  return services.isEmpty() ? QString() : QString(" <i>(%1)</i>").arg(services.join(", "));
}

}  // namespace

QString readinessWords(const GatewayState& state) {
  if (!state.is_found) {
    return "<span style='color:#c62828'><b>No gateway</b> answers in this namespace.</span>";
  }
  if (!state.readiness) return "The gateway answers.";
  QStringList met, lines;
  for (const ReadinessCondition& condition : state.readiness->conditions) {
    if (condition.is_met) {
      met << escaped(condition.name);
    } else {
      lines << QString("<span style='color:#c62828'>&#10007; <b>%1</b>: %2</span>%3")
                   .arg(escaped(condition.name), escaped(condition.message), neededBy(condition));
    }
  }
  if (state.readiness->is_ready) lines.prepend("<span style='color:#2e7d32'><b>&#10003; Ready</b></span>");
  if (!met.isEmpty()) lines << QString("<span style='color:#2e7d32'>&#10003; %1</span>").arg(met.join(", "));
  return lines.join("<br>");
}

ReadinessView::ReadinessView(PanelModel* model, QWidget* parent)
    : QGroupBox("Readiness", parent), model_(*model), words_(new QLabel) {
  words_->setObjectName("readiness");
  words_->setWordWrap(true);
  words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  auto* const layout = new QVBoxLayout(this);
  layout->addWidget(words_);
  connect(&model_.gateway(), &GatewayLink::stateChanged, this, &ReadinessView::showState);
  showState();
}

void ReadinessView::showState() {
  const QString words = readinessWords(model_.gateway().state());
  if (words != words_->text()) words_->setText(words);
}

}  // namespace external_command
