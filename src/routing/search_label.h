// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "external_command/routing/router.h"

namespace external_command {

/// What a search holds lane changes to.
enum class ChangeRule {
  kWithRoom,     ///< `min_lane_change_length`, or, at a price, what two arcs need (change_room.h)
  kWithoutRoom,  ///< no length at all: only tells why the other found nothing
};

/// A place the search has reached, and how it came there from `parent`.
struct SearchLabel {
  enum class Move : std::uint8_t {
    kStart,     ///< at a start candidate
    kFollow,    ///< to the end of the parent's lane, and onto the beginning of this one
    kChange,    ///< along the parent's lane to `change_s`, and from there across onto this one
    kContinue,  ///< on across from one lane to another, both begun further back
    kArrive,    ///< along the parent's lane, which is this one, to a way point or goal
  };

  LaneIndex lane = 0;
  double s = 0.0;         ///< [m]
  double distance = 0.0;  ///< driven so far; from `anchor_s` on it counts along this lane [m]
  double anchor_s = 0.0;  ///< where this stretch of road was entered, on this lane even if it was on one beside it [m]
  double cost = 0.0;      ///< `distance` and the prices of lane changes and candidates [m]
  double free_to = 0.0;   ///< how far one can drive on along the lane [m]
  std::int32_t parent = -1;
  std::int32_t next_on_lane = -1;
  Move move = Move::kStart;
  bool is_done = false;                 ///< settled, or beaten by a better label
  LaneChange side = LaneChange::kNone;  ///< of kChange and kContinue
  double change_s = 0.0;                ///< of kChange: on the parent's lane [m]
  double from_s = 0.0;                  ///< of kChange and kContinue: where this lane is first abreast [m]
  double change_length = 0.0;           ///< the least this change needs, along the lane changed to [m]
  std::int32_t candidate = -1;          ///< of kStart and kArrive: which
};

}  // namespace external_command
