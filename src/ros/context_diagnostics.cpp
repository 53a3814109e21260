// SPDX-License-Identifier: Apache-2.0
// What the context's diagnostics tell beside how the conditions stand.
#include "external_command/core/text.h"
#include "external_command/ros/diagnostics.h"
#include "external_command/ros/process_context.h"
#include "external_command/ros/status_name.h"
#include "external_command/ros/steady_time.h"

namespace external_command {

namespace {

void tellPose(const VehiclePose& vehicle, Diagnostics::Status* status) {
  const std::optional<double> age = vehicle.age();
  if (age) status->add("age [s]", *age);
  try {
    const Pose2d pose = vehicle.get();
    status->add("x [m]", pose.x);
    status->add("y [m]", pose.y);
    status->add("heading [rad]", pose.heading);
  } catch (const NotReady&) {
    // The message tells why.
  }
}

void tellLoad(const PlanningPool::Load& load, Diagnostics::Status* status) {
  status->add("commands in work", load.commands);
  status->add("dry runs in work", load.dry_runs);
  status->add("commands that wait", load.waiting_commands);
  status->add("dry runs that wait", load.waiting_dry_runs);
}

void tellCommands(const CommandRegistry& registry, const RefusalCounts& refusals, Diagnostics::Status* status) {
  const std::optional<CommandStatus> newest = registry.newest();
  status->summary(Diagnostics::Status::OK, newest ? text(newest->service, " ", newest->command_id, ": ",
                                                         statusName(newest->status), ", ", newest->message)
                                                  : "no command has come yet");
  status->add("running", registry.running().size());
  for (std::size_t code = 1; code < RefusalCounts::kCodes; ++code) {
    const auto reason = static_cast<ErrorCode>(code);
    if (refusals.of(reason) > 0) status->add(text("refused ", toString(reason)), refusals.of(reason));
  }
}

}  // namespace

std::unique_ptr<Diagnostics> ProcessContext::makeDiagnostics(const ros::NodeHandle& parameters) {
  auto diagnostics = std::make_unique<Diagnostics>(nh_, parameters, conditions_);
  diagnostics->add("pose", [this](Diagnostics::Status& status) { tellPose(vehicle_pose_, &status); });
  diagnostics->add("planner", [this](Diagnostics::Status& status) {
    if (hasPlannerReported()) status.add("since its last report [s]", steadyNow() - last_report_);
  });
  diagnostics->add("planning", [this](Diagnostics::Status& status) { tellLoad(planning_pool_->load(), &status); });
  diagnostics->add("commands", [this](Diagnostics::Status& status) { tellCommands(registry_, refusals_, &status); });
  return diagnostics;
}

}  // namespace external_command
