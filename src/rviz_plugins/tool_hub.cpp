// SPDX-License-Identifier: Apache-2.0
#include "tool_hub.h"

namespace external_command {

ToolHub& ToolHub::instance() {
  static ToolHub* const hub = new ToolHub;  // never deleted: panels go late
  return *hub;
}

void ToolHub::favour(QObject* panel) {
  if (favoured_ == panel) return;
  favoured_ = panel;
  Q_EMIT favourChanged();
}

bool ToolHub::isFavoured(QObject* panel) {
  if (!favoured_) favoured_ = panel;
  return favoured_ == panel;
}

}  // namespace external_command
