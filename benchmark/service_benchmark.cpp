// SPDX-License-Identifier: Apache-2.0
// Round trip of a lane-follow call from a persistent client beside that of an empty service in the same manager.
// service_benchmark X0 Y0 X1 Y1 [CALLS]: from (X0, Y0) to (X1, Y1) [m]; prints one JSON object.
#include <ros/ros.h>
#include <roscpp/Empty.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "service_benchmark", ros::init_options::AnonymousName);
  if (argc < 5) {
    std::fprintf(stderr, "usage: service_benchmark X0 Y0 X1 Y1 [CALLS]\n");
    return 2;
  }
  const int calls = argc > 5 ? std::atoi(argv[5]) : 1000;
  ros::NodeHandle nh;
  ros::service::waitForService("external_command/lane_follow", ros::Duration(20.0));
  ros::service::waitForService("empty", ros::Duration(20.0));
  auto empty_client = nh.serviceClient<roscpp::Empty>("empty", true);
  auto command_client = nh.serviceClient<LaneFollow>("external_command/lane_follow", true);

  LaneFollow command = requestOf(argv);
  roscpp::Empty nothing;
  std::vector<double> empty_times, command_times;
  const int warm_up = 50;
  for (int i = 0; i < warm_up + calls; ++i) {  // in turn, so that noise hits both alike
    const double empty_time = timeCall(empty_client, nothing);
    const double command_time = timeCall(command_client, command);
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
      "\"ratio\": %.3f, \"empty_p99_us\": %.1f, \"lane_follow_p99_us\": %.1f}\n",
      calls, command.response.report.route_length, empty, lane_follow, lane_follow / empty, quantile(empty_times, 0.99),
      quantile(command_times, 0.99));
  return 0;
}
