// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <string>

namespace external_command {

enum class PlannerLogLevel { kDebug, kInfo, kWarning, kError };

/// Takes over what OMPL has to say, which else goes to the console, for the whole process, as long as it lives.
class PlannerLog {
 public:
  using Write = std::function<void(PlannerLogLevel, const std::string&)>;

  /// The live one, or a new one that writes by `write`, which is called from any thread; an empty function silences
  /// OMPL. Kept by who needs it to live; no plan may be in work when the last one goes.
  static std::shared_ptr<PlannerLog> acquire(Write write);

  ~PlannerLog();

  PlannerLog(const PlannerLog&) = delete;
  PlannerLog& operator=(const PlannerLog&) = delete;

 private:
  class Handler;

  explicit PlannerLog(Write write);

  const std::unique_ptr<Handler> handler_;
};

}  // namespace external_command
