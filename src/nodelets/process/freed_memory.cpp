// SPDX-License-Identifier: Apache-2.0
#include "freed_memory.h"

#include <malloc.h>

namespace external_command {

namespace {

constexpr int kMostTop = 1 << 15;  // free bytes at the top of an arena, beyond which they go back to the system ...
constexpr int kTop = 1 << 13;      // ... but for these
constexpr int kLarge = 1 << 20;    // blocks that are the system's own, and go back to it at once [bytes]
constexpr int kArenas = 64;        // more than there are threads, but in a flood of requests

}  // namespace

void giveBackFreedMemory() {
  // Left alone, glibc raises these to what the largest freed block was like, and each arena keeps as much: what lies at
  // the top of an arena is not given back by malloc_trim() either.
  mallopt(M_TRIM_THRESHOLD, kMostTop);
  mallopt(M_TOP_PAD, kTop);
  mallopt(M_MMAP_THRESHOLD, kLarge);
  // By default there are eight for each core: few where there are few cores. A thread that shares one with a planner,
  // which runs below normal priority, waits for that where it is pushed aside with the arena locked: STOP must not.
  // Nor do many take much: each keeps what its thread uses, and kMostTop.
  mallopt(M_ARENA_MAX, kArenas);
}

}  // namespace external_command
