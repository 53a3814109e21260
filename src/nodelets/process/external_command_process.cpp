// SPDX-License-Identifier: Apache-2.0
#include <nodelet/loader.h>
#include <ros/ros.h>

#include <cstdio>
#include <string>

#include "external_command/core/text.h"
#include "external_command/ros/command_processor.h"
#include "external_command/ros/name_twin.h"
#include "freed_memory.h"
#include "process_end.h"
#include "start_failures.h"

namespace {

namespace ec = external_command;

/// Why this process must not start; empty where it may.
std::string whyNot(const std::string& name, bool has_component) {
  const std::string twin = ec::describeNameTwin();
  if (!twin.empty()) {
    return ec::text("there is a node ", name, " already, ", twin, ". End that one first (rosnode kill ", name,
                    "), or give this one another namespace (ns:=...)");
  }
  if (has_component && !ros::param::has(name + "/processors") && !ros::param::has(name + "/vehicle")) {
    return ec::text(
        "there are no parameters in ", name, ", neither processors (what to serve) nor vehicle (its size); ",
        "`roslaunch external_command external_command_process.launch` sets them, from the files in config/");
  }
  return "";
}

/// Says so, and waits where the same has happened before. @return the exit code.
int giveUp(const std::string& reason, ec::StartFailures* failures) {
  const double pause = failures->note(reason);
  if (pause > 0.0) ROS_WARN_STREAM("it is the same as before; waiting " << pause << " s before this process ends");
  ros::shutdown();
  ec::sleepUnlessEnding(pause);
  return 1;
}

}  // namespace

/// The component as a node of its own. It takes nodelets as a manager does; with --manager it is nothing but that.
int main(int argc, char** argv) {
  ec::giveBackFreedMemory();
  // A log in a file or a pipe tells at once too, and what was told before a kill is not lost.
  std::setvbuf(stdout, nullptr, _IOLBF, 0);
  ros::init(argc, argv, "external_command", ros::init_options::NoSigintHandler);
  ec::endOnSignal(true);
  if (!ec::waitForMaster()) return 0;
  const std::string name = ros::this_node::getName();
  ec::StartFailures failures(name);
  nodelet::V_string arguments;
  ros::removeROSArgs(argc, argv, arguments);
  const bool has_component = arguments.size() < 2 || arguments[1] != "--manager";
  const std::string obstacle = whyNot(name, has_component);
  if (ec::mustEnd()) return 0;  // a signal breaks off what is being asked of the master, too
  if (!obstacle.empty()) {
    ROS_FATAL_STREAM(name << " cannot start: " << obstacle);
    return giveUp(obstacle, &failures);
  }
  nodelet::Loader loader;
  if (ec::mustEnd()) return 0;  // roscpp forgets what it was told before it has started
  arguments.erase(arguments.begin());
  if (has_component &&
      !loader.load(name, "external_command/ExternalCommandProcessComponent", ros::names::getRemappings(), arguments)) {
    if (ec::mustEnd() || ros::isShuttingDown()) return 0;  // to be stopped while starting is no failure
    return giveUp(ec::startFailureOf(name), &failures);
  }
  ros::spin();
  return 0;
}
