// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/time.h>

namespace external_command {

/// Of a clock that nobody sets, simulated time neither: for time-outs and ages [s].
inline double steadyNow() { return ros::SteadyTime::now().toSec(); }

}  // namespace external_command
