// SPDX-License-Identifier: Apache-2.0
#include <nodelet/NodeletList.h>
#include <nodelet/NodeletLoad.h>
#include <nodelet/NodeletUnload.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <string>
#include <vector>

#include "external_command/ros/name_twin.h"
#include "process_end.h"

namespace {

namespace ec = external_command;

constexpr double kPeriod = 0.3;         // between two looks at the manager [s]
constexpr double kLongestPause = 60.0;  // between two tries that fail, and before the end of one of two of a name [s]

constexpr const char* kUsage = R"(Usage: keep_nodelet_loaded TYPE MANAGER [ARGUMENT...]

Loads a nodelet into a manager, and again whenever the manager has been started anew. As `rosrun nodelet nodelet load`
does, but without its bond: that unloads the nodelet when the loader is starved, or suspended, for some seconds. The
nodelet takes this node's name, and its parameters. It is unloaded when this process is told to end, and stays where this
process dies.
)";

/// One nodelet in one manager.
class Keeper {
 public:
  Keeper(const std::string& type, const std::string& manager, const std::vector<std::string>& arguments)
      : manager_(ros::names::resolve(manager)) {
    request_.name = ros::this_node::getName();
    request_.type = type;
    request_.my_argv = arguments;
    for (const auto& [source, target] : ros::names::getRemappings()) {
      request_.remap_source_args.push_back(source);
      request_.remap_target_args.push_back(target);
    }
  }

  /// Loads the nodelet where it is not. @return how long to wait until the next look [s].
  double look() {
    nodelet::NodeletList list;
    if (!ros::service::call(manager_ + "/list", list)) {
      if (!is_told_) ROS_INFO_STREAM("waiting for the nodelet manager " << manager_);
      is_told_ = true;
      return kPeriod;
    }
    is_told_ = false;
    const auto& loaded = list.response.nodelets;
    return std::find(loaded.begin(), loaded.end(), request_.name) != loaded.end() ? kPeriod : load();
  }

  void unload() const {
    nodelet::NodeletUnload unload;
    unload.request.name = request_.name;
    ros::service::call(manager_ + "/unload_nodelet", unload);  // fails where the manager has gone before
  }

 private:
  double load() {
    nodelet::NodeletLoad load;
    load.request = request_;
    if (ros::service::call(manager_ + "/load_nodelet", load) && load.response.success) {
      ROS_INFO_STREAM(request_.type << " is loaded into " << manager_);
      failures_ = 0;
      return kPeriod;
    }
    const double pause = std::min(kLongestPause, std::pow(2.0, std::min(++failures_, 10)));
    ROS_ERROR_STREAM(request_.type << " could not be loaded into " << manager_ << ", whose log tells why; again in "
                                   << pause << " s");
    return pause;
  }

  const std::string manager_;
  nodelet::NodeletLoad::Request request_;
  int failures_ = 0;
  bool is_told_ = false;
};

/// `rosnode kill` would shut ROS down before the nodelet is unloaded.
void endOnShutdownCall() {
  const auto end = [](XmlRpc::XmlRpcValue& /*parameters*/, XmlRpc::XmlRpcValue& result) {
    ec::noteEnd();
    result = ros::xmlrpc::responseInt(1, "", 0);
  };
  ros::XMLRPCManager::instance()->unbind("shutdown");
  ros::XMLRPCManager::instance()->bind("shutdown", end);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> arguments;
  ros::removeROSArgs(argc, argv, arguments);
  if (arguments.size() < 3) {
    std::cerr << kUsage;
    return 1;
  }
  ros::init(argc, argv, "keep_nodelet_loaded", ros::init_options::NoSigintHandler);
  ec::endOnSignal(false);
  if (!ec::waitForMaster()) return 0;
  const std::string twin = ec::describeNameTwin();
  if (!twin.empty()) {
    ROS_FATAL_STREAM("there is a node " << ros::this_node::getName() << " already, " << twin
                                        << ". End that one first, or give this one another name or namespace");
    ec::sleepUnlessEnding(kLongestPause);  // whoever starts this again need not do so every second
    return 1;
  }
  ros::start();
  endOnShutdownCall();
  Keeper keeper(arguments[1], arguments[2], {arguments.begin() + 3, arguments.end()});
  while (ec::sleepUnlessEnding(keeper.look())) {
  }
  keeper.unload();
  ros::shutdown();
  return 0;
}
