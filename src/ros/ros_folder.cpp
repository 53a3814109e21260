// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/ros_folder.h"

#include <pwd.h>
#include <unistd.h>

#include <cstdlib>

namespace external_command {

namespace {

std::string homeFolder() {
  if (const char* const home = std::getenv("HOME")) return home;
  passwd entry{};
  passwd* found = nullptr;
  char buffer[4096];
  return getpwuid_r(getuid(), &entry, buffer, sizeof buffer, &found) == 0 && found ? found->pw_dir : "/";
}

}  // namespace

std::string rosFolder(const std::string& parameter, const std::string& inside) {
  if (parameter.empty()) {
    const char* const ros_home = std::getenv("ROS_HOME");
    return (ros_home != nullptr && *ros_home != '\0' ? std::string(ros_home) : homeFolder() + "/.ros") + "/" + inside;
  }
  const bool is_home = parameter == "~" || parameter.compare(0, 2, "~/") == 0;
  return is_home ? homeFolder() + parameter.substr(1) : parameter;
}

}  // namespace external_command
