// SPDX-License-Identifier: Apache-2.0
#include "words.h"

#include <algorithm>
#include <cmath>

#include "external_command/Chassis.h"
#include "external_command/CommandStatus.h"
#include "external_command/core/error.h"
#include "external_command/ros/status_name.h"

namespace external_command {

QString statusWord(std::uint8_t status) { return statusName(status); }

QString codeWord(std::uint16_t code) { return toString(static_cast<ErrorCode>(code)); }

QString modeWords(std::uint8_t driving_mode) {
  switch (driving_mode) {
    case Chassis::COMPLETE_MANUAL:
      return "manual";
    case Chassis::COMPLETE_AUTO_DRIVE:
      return "auto";
    case Chassis::AUTO_STEER_ONLY:
      return "auto, steering only";
    case Chassis::AUTO_SPEED_ONLY:
      return "auto, speed only";
    case Chassis::EMERGENCY_MODE:
      return "EMERGENCY";
    default:
      return QString("mode %1").arg(driving_mode);
  }
}

QString durationWords(double seconds) {
  const auto all = static_cast<long long>(std::lround(std::min(std::max(seconds, 0.0), 3.6e6)));
  const QString minutes_seconds = QString("%1:%2").arg(all / 60 % 60).arg(all % 60, 2, 10, QChar('0'));
  if (all < 3600) return minutes_seconds;
  return QString("%1:%2:%3").arg(all / 3600).arg(all / 60 % 60, 2, 10, QChar('0')).arg(all % 60, 2, 10, QChar('0'));
}

QString distanceWords(double metres) {
  if (std::abs(metres) < 10.0) return QString("%1 m").arg(metres, 0, 'f', 1);
  if (std::abs(metres) < 1000.0) return QString("%1 m").arg(metres, 0, 'f', 0);
  return QString("%1 km").arg(metres / 1000.0, 0, 'f', 1);
}

QString speedWords(double metres_per_second) { return QString("%1 km/h").arg(3.6 * metres_per_second, 0, 'f', 1); }

QString reportWords(const PlanReport& report) {
  QString words;
  if (report.path_length > 0.0) words = "path " + distanceWords(report.path_length);
  if (report.reverse_length > 0.0) words += QString(", %1 of it in reverse").arg(distanceWords(report.reverse_length));
  if (report.coverage_ratio > 0.0) words += QString(", %1 % covered").arg(100.0 * report.coverage_ratio, 0, 'f', 1);
  for (const std::string& warning : report.warnings) {
    words += (words.isEmpty() ? "warning: " : "; warning: ") + QString::fromStdString(warning);
  }
  return words;
}

QString serviceWords(const std::string& service) { return QString::fromStdString(service).replace('_', ' '); }

}  // namespace external_command
