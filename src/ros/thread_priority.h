// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace external_command {

/// Puts the calling thread below the others of its process: beside a busy one of them it gets a tenth of the time.
void lowerThreadPriority();

/// Gives the calling thread real-time priority, where the process may ask for that.
void raiseThreadPriority();

}  // namespace external_command
