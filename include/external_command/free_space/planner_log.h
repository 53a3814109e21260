// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace external_command {

enum class PlannerLogLevel { kDebug, kInfo, kWarning, kError };

using PlannerLog = std::function<void(PlannerLogLevel, const std::string&)>;

/// Takes over what OMPL has to say, which goes to the console otherwise; an empty function silences it. For the whole
/// process, until the next call. `log` may be called from any thread.
void setPlannerLog(PlannerLog log);

}  // namespace external_command
