// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ostream>
#include <string>

#include "map_check.h"

namespace external_command {

/// One JSON object: what the map holds, each finding on a line of its own, notes. doc/check_map.md describes it.
void writeReport(const MapReport& report, const std::string& file, std::ostream& out);

/// One JSON list: every kind of finding, with its severity, meaning and advice.
void writeKinds(std::ostream& out);

}  // namespace external_command
