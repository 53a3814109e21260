// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "search_label.h"

namespace external_command {

/// Memory of LabelSearch that outlives a query, so that the next one of this thread need not clear or allocate it.
struct SearchWorkspace {
  struct QueueEntry {
    double cost;  ///< of the label, and the rest of the route at least [m]
    std::int32_t label;
    /// The cheapest on top; among equals the one found first.
    bool operator<(const QueueEntry& other) const {
      return cost != other.cost ? cost > other.cost : label > other.label;
    }
  };

  struct Target {
    LanePoint place;
    std::int32_t candidate;
    std::int32_t next_on_lane;
    bool is_reached;
  };

  /// What the search knows of a lane; stale where `leg` is not that of the workspace.
  struct LaneSlot {
    std::uint64_t leg = 0;
    std::int32_t first_label = -1;
    std::int32_t first_target = -1;
  };

  /// What a large search took goes back; of small ones it is kept.
  void giveBack() {
    constexpr std::size_t kKept = 50'000;  // labels, of 100 bytes or so
    if (labels.capacity() > kKept) std::vector<SearchLabel>().swap(labels);
    if (queue.capacity() > kKept) std::vector<QueueEntry>().swap(queue);
  }

  LaneSlot& slotOf(LaneIndex lane) {
    LaneSlot& slot = lanes[lane];
    if (slot.leg != leg) slot = {leg, -1, -1};
    return slot;
  }

  std::vector<SearchLabel> labels;
  std::vector<QueueEntry> queue;
  std::vector<Target> targets;
  std::vector<Target> reached_targets;  ///< of the leg before
  std::vector<LaneSlot> lanes;
  std::uint64_t leg = 0;
};

}  // namespace external_command
