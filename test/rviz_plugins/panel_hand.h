// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QApplication>
#include <QCheckBox>
#include <QComboBox>
#include <QPushButton>
#include <QTest>
#include <QTextBrowser>
#include <sstream>
#include <stdexcept>
#include <string>

#include "rviz_plugins/command_panel.h"
#include "rviz_plugins/tool_hub.h"

namespace external_command {

constexpr int kDeadline = 60000;  // [ms]; what is late by that much does not come

/// Uses a panel as a person does: clicks, chooses, reads.
class PanelHand {
 public:
  explicit PanelHand(CommandPanel* panel) : panel_(*panel) {}

  template <class Widget>
  Widget* widget(const char* name) const {
    auto* const found = panel_.findChild<Widget*>(name);
    if (found == nullptr) throw std::runtime_error(std::string("the panel has no widget ") + name);
    return found;
  }

  void press(const char* button) const { QTest::mouseClick(widget<QPushButton>(button), Qt::LeftButton); }
  void choose(CommandKind kind) const { widget<QComboBox>("kind")->setCurrentIndex(static_cast<int>(kind)); }
  void write(const char* box, const std::string& text) const {
    widget<QComboBox>(box)->setEditText(QString::fromStdString(text));
  }

  std::string answers() const { return widget<QTextBrowser>("answers")->toPlainText().toStdString(); }
  bool answersHold(const std::string& words) const { return answers().find(words) != std::string::npos; }
  std::string text(const char* label) const { return widget<QLabel>(label)->text().toStdString(); }

  /// Lets the panel go on until `condition()` is true; false: it is not within the deadline.
  template <class Condition>
  static bool waitUntil(const Condition& condition) {
    return QTest::qWaitFor([&] { return condition(); }, kDeadline);
  }

  /// Waits for an answer that begins with `what` and holds `words`.
  bool waitForAnswer(const std::string& what, const std::string& words) const {
    return waitUntil([&] {
      std::istringstream lines(answers());
      for (std::string line; std::getline(lines, line);) {
        if (line.rfind(what, 0) == 0 && line.find(words) != std::string::npos) return true;
      }
      return false;
    });
  }
  bool waitForAnswer(const std::string& words) const {
    return waitUntil([&] { return answersHold(words); });
  }

 private:
  CommandPanel& panel_;
};

}  // namespace external_command
