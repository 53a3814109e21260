// SPDX-License-Identifier: Apache-2.0
// Round trip of a lane-follow call from a persistent client beside that of an empty service in the same manager.
// service_benchmark X0 Y0 X1 Y1 [CALLS [VEHICLE...]]: from (X0, Y0), where the vehicle stands, to (X1, Y1) [m]; prints
// one JSON object. VEHICLE is the namespace of a component in that manager; with several, each is called in its turn.
#include <ros/ros.h>
#include <roscpp/Empty.h>
#include <tf2_msgs/TFMessage.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "external_command/LaneFollow.h"

namespace {

using external_command::CommandStatus;
using external_command::LaneFollow;

/// Microseconds that one call takes; ends the program where it fails.
template <class Service>
double timeCall(ros::ServiceClient& client, Service& service) {
  const auto begin = std::chrono::steady_clock::now();
  if (!client.call(service)) {
    std::fprintf(stderr, "service_benchmark: the call of %s failed\n", client.getService().c_str());
    std::exit(1);
  }
  return std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count();
}

double quantile(std::vector<double> times, double share) {
  std::sort(times.begin(), times.end());
  return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
}

/// roscpp's own function tells of it on standard output. Ends the program where the service does not come.
void waitFor(const std::string& service) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!ros::service::exists(service, false)) {
    if (std::chrono::steady_clock::now() > end) {
      std::fprintf(stderr, "service_benchmark: %s is not there after 60 s\n", service.c_str());
      std::exit(1);
    }
    ros::WallDuration(0.05).sleep();
  }
}

/// Namespaces, this node's own where none is given.
std::vector<std::string> vehiclesOf(int argc, char** argv) {
  std::vector<std::string> vehicles(argv + std::min(argc, 6), argv + argc);
  if (vehicles.empty()) vehicles.push_back(ros::this_node::getNamespace());
  return vehicles;
}

LaneFollow requestOf(char** argv) {
  LaneFollow service;
  auto& command = service.request.command;
  command.is_start_pose_set = true;
  command.way_point.resize(1);
  command.way_point[0].x = std::atof(argv[1]);
  command.way_point[0].y = std::atof(argv[2]);
  command.end_pose.x = std::atof(argv[3]);
  command.end_pose.y = std::atof(argv[4]);
  return service;
}

/// Of a vehicle that stands at the start.
tf2_msgs::TFMessage poseOf(const LaneFollow& service) {
  tf2_msgs::TFMessage message;
  message.transforms.resize(1);
  geometry_msgs::TransformStamped& pose = message.transforms.front();
  pose.header.frame_id = "map";
  pose.child_frame_id = "base_link";
  pose.transform.translation.x = service.request.command.way_point[0].x;
  pose.transform.translation.y = service.request.command.way_point[0].y;
  pose.transform.rotation.w = 1.0;
  return message;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "service_benchmark", ros::init_options::AnonymousName);
  if (argc < 5) {
    std::fprintf(stderr, "usage: service_benchmark X0 Y0 X1 Y1 [CALLS [VEHICLE...]]\n");
    return 2;
  }
  const int calls = argc > 5 ? std::atoi(argv[5]) : 1000;
  ros::NodeHandle nh;
  waitFor("empty");
  auto empty_client = nh.serviceClient<roscpp::Empty>("empty", true);
  std::vector<ros::ServiceClient> command_clients;
  for (const std::string& vehicle : vehiclesOf(argc, argv)) {
    const std::string service = ros::names::append(vehicle, "external_command/lane_follow");
    waitFor(service);
    command_clients.push_back(nh.serviceClient<LaneFollow>(service, true));
  }

  LaneFollow command = requestOf(argv);
  const ros::Publisher transforms = nh.advertise<tf2_msgs::TFMessage>("/tf_static", 1, true);
  transforms.publish(poseOf(command));
  roscpp::Empty nothing;
  std::vector<double> empty_times, command_times;
  const int warm_up = std::max(50, 2 * static_cast<int>(command_clients.size()));
  for (int i = 0; i < warm_up + calls; ++i) {  // in turn, so that noise hits both alike
    const double empty_time = timeCall(empty_client, nothing);
    const double command_time =
        timeCall(command_clients[static_cast<std::size_t>(i) % command_clients.size()], command);
    if (command.response.status.status != CommandStatus::RUNNING) {
      std::fprintf(stderr, "service_benchmark: refused: %s\n", command.response.status.message.c_str());
      return 1;
    }
    if (i < warm_up) continue;
    empty_times.push_back(empty_time);
    command_times.push_back(command_time);
  }
  const double empty = quantile(empty_times, 0.5), lane_follow = quantile(command_times, 0.5);
  std::printf(
      "{\"benchmark\": \"service\", \"calls\": %d, \"route_m\": %.1f, \"empty_us\": %.1f, \"lane_follow_us\": %.1f, "
      "\"ratio\": %.3f, \"empty_p99_us\": %.1f, \"lane_follow_p99_us\": %.1f, \"vehicles\": %zu}\n",
      calls, command.response.report.route_length, empty, lane_follow, lane_follow / empty, quantile(empty_times, 0.99),
      quantile(command_times, 0.99), command_clients.size());
  return 0;
}
