// SPDX-License-Identifier: Apache-2.0
// A nodelet manager that holds the component and, for comparison, a service that does nothing.
#include <nodelet/loader.h>
#include <ros/ros.h>
#include <roscpp/Empty.h>

int main(int argc, char** argv) {
  ros::init(argc, argv, "external_command");
  nodelet::Loader loader;
  if (!loader.load(ros::this_node::getName(), "external_command/ExternalCommandProcessComponent",
                   ros::names::getRemappings(), {})) {
    return 1;
  }
  ros::NodeHandle nh;
  const boost::function<bool(roscpp::Empty::Request&, roscpp::Empty::Response&)> do_nothing =
      [](roscpp::Empty::Request& /*request*/, roscpp::Empty::Response& /*response*/) { return true; };
  const ros::ServiceServer empty = nh.advertiseService("empty", do_nothing);
  ros::spin();
  return 0;
}
