// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "lane_cuts.h"
#include "recent_memory.h"

namespace external_command {

/// The lanes of a plain section (PathSection::isPlain()).
struct SectionKey {
  std::vector<LaneRange> pieces;

  bool operator==(const SectionKey& other) const {
    return std::equal(pieces.begin(), pieces.end(), other.pieces.begin(), other.pieces.end(),
                      [](const LaneRange& a, const LaneRange& b) {
                        return a.lane == b.lane && a.from_s == b.from_s && a.to_s == b.to_s;
                      });
  }
};

struct SectionHash {
  std::size_t operator()(const SectionKey& key) const {
    std::size_t sum = key.pieces.size();
    const std::hash<double> hash;
    for (const LaneRange& piece : key.pieces) {
      for (const std::size_t part : {std::size_t{piece.lane}, hash(piece.from_s), hash(piece.to_s)}) {
        sum ^= part + 0x9e3779b97f4a7c15 + (sum << 6) + (sum >> 2);
      }
    }
    return sum;
  }
};

/// What paths of one map, vehicle and set of parameters have in common.
struct SectionMemory {
  RecentMemory<SectionKey, ReferencePath, SectionHash> paths{400000};    ///< by points
  RecentMemory<LaneIndex, LaneCuts, std::hash<LaneIndex>> cuts{400000};  ///< by places
};

}  // namespace external_command
