// SPDX-License-Identifier: Apache-2.0
#include "external_command/free_space/planner_log.h"

#include <ompl/util/Console.h>

#include <mutex>
#include <utility>

namespace external_command {

namespace {

std::mutex mutex;

/// OMPL's own. Not the one before: that may be of a log that is just going.
ompl::msg::OutputHandler* console() {
  static ompl::msg::OutputHandler* const handler = ompl::msg::getOutputHandler();
  return handler;
}

PlannerLogLevel levelOf(ompl::msg::LogLevel level) {
  if (level >= ompl::msg::LOG_ERROR) return PlannerLogLevel::kError;
  if (level == ompl::msg::LOG_WARN) return PlannerLogLevel::kWarning;
  return level == ompl::msg::LOG_INFO ? PlannerLogLevel::kInfo : PlannerLogLevel::kDebug;
}

}  // namespace

class PlannerLog::Handler : public ompl::msg::OutputHandler {
 public:
  explicit Handler(Write write) : write_(std::move(write)) {}

  void log(const std::string& text, ompl::msg::LogLevel level, const char* /*file*/, int /*line*/) override {
    if (write_) write_(levelOf(level), text);
  }

 private:
  const Write write_;
};

std::shared_ptr<PlannerLog> PlannerLog::acquire(Write write) {
  static std::weak_ptr<PlannerLog> live;
  const std::lock_guard<std::mutex> lock(mutex);
  auto log = live.lock();
  if (!log) live = log = std::shared_ptr<PlannerLog>(new PlannerLog(std::move(write)));
  return log;
}

PlannerLog::PlannerLog(Write write) : handler_(std::make_unique<Handler>(std::move(write))) {
  console();
  ompl::msg::useOutputHandler(handler_.get());
}

/// This library may be unloaded after it, while another one of the process goes on with OMPL.
PlannerLog::~PlannerLog() {
  const std::lock_guard<std::mutex> lock(mutex);
  if (ompl::msg::getOutputHandler() == handler_.get()) ompl::msg::useOutputHandler(console());
}

}  // namespace external_command
