// SPDX-License-Identifier: Apache-2.0
#include "external_command/free_space/planner_log.h"

#include <ompl/util/Console.h>

#include <utility>

namespace external_command {

namespace {

PlannerLogLevel levelOf(ompl::msg::LogLevel level) {
  if (level >= ompl::msg::LOG_ERROR) return PlannerLogLevel::kError;
  if (level == ompl::msg::LOG_WARN) return PlannerLogLevel::kWarning;
  return level == ompl::msg::LOG_INFO ? PlannerLogLevel::kInfo : PlannerLogLevel::kDebug;
}

class Forwarder : public ompl::msg::OutputHandler {
 public:
  explicit Forwarder(PlannerLog log) : log_(std::move(log)) {}

  void log(const std::string& text, ompl::msg::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (log_) log_(levelOf(level), text);
  }

 private:
  PlannerLog log_;
};

}  // namespace

void setPlannerLog(PlannerLog log) {
  // Never deleted: OMPL keeps the pointer, and other threads may be using it.
  ompl::msg::useOutputHandler(new Forwarder(std::move(log)));
}

}  // namespace external_command
