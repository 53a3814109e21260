// SPDX-License-Identifier: Apache-2.0
#include "answers_view.h"

#include <QVBoxLayout>

#include "status_colors.h"
#include "words.h"

namespace external_command {

QString answerWords(const Answer& answer, const std::string& vehicle) {
  QString title = answer.what.toHtmlEscaped();
  if (answer.command_id != 0) title += QString(" %1").arg(answer.command_id);
  if (answer.vehicle != vehicle) title += QString(" of %1").arg(QString::fromStdString(answer.vehicle).toHtmlEscaped());
  const QString color = answer.status ? statusColor(*answer.status) : "#b26a00";
  const QString status = answer.status ? " " + statusWord(*answer.status) : QString();
  const QString code = answer.code == 0 ? QString() : QString(" %1 (%2)").arg(codeWord(answer.code)).arg(answer.code);
  const QString words = answer.words.isEmpty() ? QString() : ": " + answer.words.toHtmlEscaped();
  return QString("<p style='margin:2px 0'><b>%1</b><span style='color:%2'><b>%3%4</b></span>%5</p>")
      .arg(title, color, status, code, words);
}

AnswersView::AnswersView(PanelModel* model, QWidget* parent)
    : QGroupBox("Answers", parent), model_(*model), text_(new QTextBrowser) {
  text_->setObjectName("answers");
  text_->setOpenLinks(false);
  text_->setMinimumHeight(110);
  auto* const layout = new QVBoxLayout(this);
  layout->addWidget(text_);
  connect(&model_, &PanelModel::answersChanged, this, &AnswersView::showAnswers);
}

void AnswersView::showAnswers() {
  QString html;
  for (const Answer& answer : model_.answers()) html += answerWords(answer, model_.gateway().vehicle());
  text_->setHtml(html);
}

}  // namespace external_command
