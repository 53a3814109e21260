// SPDX-License-Identifier: Apache-2.0
#include "process_end.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <signal.h>

#include <chrono>
#include <thread>

namespace external_command {

namespace {

volatile sig_atomic_t must_end = 0;
volatile sig_atomic_t must_shut_ros_down = 0;

void onSignal(int /*number*/) {
  must_end = 1;
  if (must_shut_ros_down != 0) ros::requestShutdown();
}

}  // namespace

void endOnSignal(bool shuts_ros_down) {
  must_shut_ros_down = shuts_ros_down ? 1 : 0;
  struct sigaction action = {};
  action.sa_handler = onSignal;
  for (const int number : {SIGINT, SIGTERM}) sigaction(number, &action, nullptr);
}

bool mustEnd() { return must_end != 0; }

void noteEnd() { must_end = 1; }

bool sleepUnlessEnding(double duration) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(duration);
  while (!mustEnd() && std::chrono::steady_clock::now() < end) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  return !mustEnd();
}

bool waitForMaster() {
  bool is_told = false;
  while (!mustEnd() && !ros::master::check()) {
    if (!is_told) ROS_ERROR_STREAM("no ROS master answers at " << ros::master::getURI() << "; waiting for one");
    is_told = true;
    sleepUnlessEnding(0.2);
  }
  return !mustEnd();
}

}  // namespace external_command
