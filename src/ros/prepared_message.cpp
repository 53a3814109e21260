// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/prepared_message.h"

namespace external_command {

void PreparedMessage::send() const { publisher_.publish(bytes_); }

}  // namespace external_command
