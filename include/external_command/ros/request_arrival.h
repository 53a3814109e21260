// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/header.h>

#include <string>

#include "external_command/ros/command_gate.h"

namespace external_command {

/// A request may have waited in another place of this vehicle before it became a call: in the line of the adapter for
/// legacy requests. The connection header of that call then tells when it really came in, so that a STOP in between
/// stops it too.
///
/// Within the process that is the gate's own arrival number. Between processes it is the time of day, which the stop
/// is compared with; the clocks of two machines must agree.
ros::M_string arrivalHeader(const CommandGate& gate, ArrivalNumber arrival, const ros::WallTime& time);

/// The arrival that the header tells of, where that is earlier than `arrival`; else `arrival`.
ArrivalNumber earlierArrival(const ros::M_string& header, const CommandGate& gate, ArrivalNumber arrival);

}  // namespace external_command
