// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace external_command {

/// Makes the allocator of this process give back what is freed, and keeps its threads out of each other's way. To be
/// called before the first thread is made.
void giveBackFreedMemory();

}  // namespace external_command
