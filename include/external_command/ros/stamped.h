// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

namespace external_command {

/// A message as it is passed on: with the present time where its sender gave none, so that who gets it can tell its
/// age.
template <class Message>
Message stamped(Message message) {
  if (message.header.stamp.isZero()) message.header.stamp = ros::Time::now();
  return message;
}

}  // namespace external_command
