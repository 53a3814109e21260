// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QGroupBox>
#include <QTextBrowser>

#include "panel_model.h"

namespace external_command {

/// The last answers, with code and reason, and how commands have ended; the newest first.
class AnswersView : public QGroupBox {
  Q_OBJECT
 public:
  /// @param model  must live as long as this.
  AnswersView(PanelModel* model, QWidget* parent = nullptr);

 private:
  void showAnswers();

  PanelModel& model_;
  QTextBrowser* const text_;
};

/// For a person, as HTML. @param vehicle  whose namespace need not be named.
QString answerWords(const Answer& answer, const std::string& vehicle);

}  // namespace external_command
