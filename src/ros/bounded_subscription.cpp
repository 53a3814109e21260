// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/bounded_subscription.h"

#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/status.h"

namespace external_command {

void noteDroppedMessage(const std::string& topic, const ros::M_string& header) {
  static LogThrottle throttle(10.0);
  const auto publisher = header.find("callerid");
  logLater(LogLevel::kWarn, throttle,
           text("a message on ", topic, " from ",
                publisher == header.end() ? std::string("somebody unknown") : printable(publisher->second),
                " was dropped: ", statusFrom(std::current_exception(), 0).message));
}

}  // namespace external_command
