// SPDX-License-Identifier: Apache-2.0
// How long a STOP takes from a persistent client. Two modes:
// stop_benchmark probe CALLS                    prints one JSON object with the round trips of CALLS stops
// stop_benchmark load light|planners CLIENTS    calls light services, or planners, from CLIENTS connections until
// killed
#include <ros/ros.h>
#include <sched.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "external_command/Action.h"
#include "external_command/FreeSpace.h"
#include "external_command/GetCommandStatus.h"
#include "external_command/LaneFollow.h"
#include "external_command/PreciseParking.h"
#include "external_command/Speed.h"
#include "external_command/ValetParking.h"
#include "external_command/ZoneCover.h"
#include "statistics.h"

namespace {

using namespace external_command;  // NOLINT(build/namespaces): messages only

constexpr double kPause = 0.005;  // between two stops [s]

/// Where that is allowed: what is timed is then how long the gateway takes, not when this client gets the processor.
/// Before roscpp starts its threads, which inherit it.
bool askForRealTime() {
  sched_param parameters{};
  parameters.sched_priority = sched_get_priority_min(SCHED_RR);
  return sched_setscheduler(0, SCHED_RR, &parameters) == 0;
}

int probe(int calls, bool is_real_time) {
  ros::NodeHandle nh;
  ros::service::waitForService("external_command/action", ros::Duration(60.0));
  auto client = nh.serviceClient<Action>("external_command/action", true);
  Action stop;
  stop.request.command.command = ActionCommand::STOP;
  std::vector<double> times;
  for (int i = 0; i < calls; ++i) {
    const auto begin = std::chrono::steady_clock::now();
    if (!client.call(stop) || stop.response.status.status != CommandStatus::RUNNING) {
      std::fprintf(stderr, "stop_benchmark: a stop failed: %s\n", stop.response.status.message.c_str());
      return 1;
    }
    times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    ros::WallDuration(kPause).sleep();
  }
  std::printf("{\"stops\": %d, \"median_ms\": %.3f, \"p99_ms\": %.3f, \"max_ms\": %.3f, \"real_time_client\": %s}\n",
              calls, benchmark::quantile(times, 0.5), benchmark::quantile(times, 0.99), benchmark::largest(times),
              is_real_time ? "true" : "false");
  return 0;
}

/// Calls one service again and again; a connection that breaks is made anew.
template <class Service>
void callForEver(const std::string& name, Service service) {
  ros::NodeHandle nh;
  ros::ServiceClient client;
  while (ros::ok()) {
    if (!client.isValid()) client = nh.serviceClient<Service>(name, true);
    if (!client.call(service)) ros::WallDuration(0.1).sleep();
  }
}

RoiPolygon square(double side) {
  RoiPolygon polygon;
  for (const auto& [x, y] : {std::pair(0.0, 0.0), std::pair(side, 0.0), std::pair(side, side), std::pair(0.0, side)}) {
    geometry_msgs::Point point;
    point.x = x;
    point.y = y;
    polygon.points.push_back(point);
  }
  return polygon;
}

/// Each planner in turn; every second client plans for real, so that commands cancel one another too.
void callPlanner(int client) {
  const bool dry_run = client % 2 == 0;
  switch ((client / 2) % 4) {
    case 0: {
      FreeSpace service;
      service.request.command.dry_run = dry_run;
      service.request.command.parking_spot_pose.x = 60.0;
      service.request.command.parking_spot_pose.y = 90.0;
      service.request.command.parking_spot_pose.has_heading = true;
      return callForEver("external_command/free_space", service);
    }
    case 1: {
      ZoneCover service;
      auto& command = service.request.command;
      command.dry_run = dry_run;
      command.drivable_roi = square(150.0);
      command.is_start_pose_set = true;
      command.way_point.resize(1);
      command.way_point[0].x = command.way_point[0].y = 75.0;
      command.way_point[0].has_heading = true;
      return callForEver("external_command/zone_cover", service);
    }
    case 2: {
      ValetParking service;
      service.request.command.dry_run = dry_run;
      service.request.command.parking_spot_id = "n_out_5";
      return callForEver("external_command/valet_parking", service);
    }
    default: {
      PreciseParking service;
      auto& command = service.request.command;
      command.dry_run = dry_run;
      command.parking_spot_pose.x = 322.0;
      command.parking_spot_pose.y = 110.0;
      command.parking_spot_pose.has_heading = true;
      command.parking_inwards = true;
      return callForEver("external_command/precise_parking", service);
    }
  }
}

void callLightService(int client) {
  switch (client % 3) {
    case 0: {
      GetCommandStatus service;
      service.request.command_id = 1;
      return callForEver("external_command/command_status", service);
    }
    case 1: {
      Speed service;
      service.request.command.kind = SpeedCommand::RESTORE_TARGET_SPEED;
      return callForEver("external_command/speed", service);
    }
    default: {
      LaneFollow service;
      service.request.command.dry_run = true;
      service.request.command.end_pose.x = 280.0;
      service.request.command.end_pose.y = 194.75;
      return callForEver("external_command/lane_follow", service);
    }
  }
}

int load(const std::string& kind, int clients) {
  std::vector<std::thread> threads;
  for (int i = 0; i < clients; ++i) threads.emplace_back(kind == "light" ? callLightService : callPlanner, i);
  ros::waitForShutdown();
  for (std::thread& thread : threads) thread.join();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  const bool is_real_time = mode == "probe" && askForRealTime();
  ros::init(argc, argv, "stop_benchmark", ros::init_options::AnonymousName);
  const ros::NodeHandle nh;  // starts ROS
  if (mode == "probe" && argc == 3 && std::atoi(argv[2]) > 0) return probe(std::atoi(argv[2]), is_real_time);
  const std::string kind = argc > 2 ? argv[2] : "";
  if (mode == "load" && argc == 4 && (kind == "light" || kind == "planners")) return load(kind, std::atoi(argv[3]));
  std::fprintf(stderr, "usage: stop_benchmark probe CALLS | stop_benchmark load light|planners CLIENTS\n");
  return 2;
}
