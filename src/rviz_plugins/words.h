// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QString>
#include <cstdint>
#include <string>

#include "external_command/PlanReport.h"

namespace external_command {

/// Of CommandStatus: RUNNING, FINISHED, ...
QString statusWord(std::uint8_t status);

/// Of CommandStatus: NO_ROUTE, ...; UNKNOWN_CODE for a number that it does not have
QString codeWord(std::uint16_t code);

/// Of Chassis: "automatic", "by hand", ...
QString modeWords(std::uint8_t driving_mode);

/// "0:42", "1:05:00"
QString durationWords(double seconds);

/// "312 m", "1.2 km"
QString distanceWords(double metres);

/// "14.4 km/h"
QString speedWords(double metres_per_second);

/// What was planned: "path 228 m, 12 m of it in reverse; warning: ..."
QString reportWords(const PlanReport& report);

/// "lane_follow" for a person: "lane follow"
QString serviceWords(const std::string& service);

}  // namespace external_command
