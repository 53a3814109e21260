// SPDX-License-Identifier: Apache-2.0
// A nodelet manager that holds the component and, for comparison, a service that does nothing. The environment variable
// EC_BENCHMARK_VEHICLES may name namespaces of further components, with the same parameters.
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <roscpp/Empty.h>

#include <cstdlib>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include "nodelets/process/freed_memory.h"

namespace {

std::vector<std::string> furtherVehicles() {
  const char* const names = std::getenv("EC_BENCHMARK_VEHICLES");
  std::istringstream words(names == nullptr ? "" : names);
  return {std::istream_iterator<std::string>(words), {}};
}

}  // namespace

int main(int argc, char** argv) {
  external_command::giveBackFreedMemory();  // as the process of a vehicle does
  ros::init(argc, argv, "external_command");
  const std::vector<std::string> vehicles = furtherVehicles();
  ros::param::set("~map_cache_folder", "none");  // nothing else is written meanwhile
  XmlRpc::XmlRpcValue parameters;
  ros::param::get(ros::this_node::getNamespace(), parameters);
  for (const std::string& vehicle : vehicles) ros::param::set(vehicle, parameters);
  nodelet::Loader loader;
  std::vector<std::string> components{ros::this_node::getName()};
  for (const std::string& vehicle : vehicles) components.push_back(vehicle + "/external_command");
  for (const std::string& component : components) {
    if (!loader.load(component, "external_command/ExternalCommandProcessComponent", ros::names::getRemappings(), {})) {
      return 1;
    }
  }
  ros::NodeHandle nh;
  const boost::function<bool(roscpp::Empty::Request&, roscpp::Empty::Response&)> do_nothing =
      [](roscpp::Empty::Request& /*request*/, roscpp::Empty::Response& /*response*/) { return true; };
  const ros::ServiceServer empty = nh.advertiseService("empty", do_nothing);
  ros::spin();
  return 0;
}
