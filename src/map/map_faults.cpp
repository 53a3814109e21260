// SPDX-License-Identifier: Apache-2.0
#include "map_faults.h"

#include <iterator>
#include <utility>

namespace external_command {

void MapFaults::append(MapFaults later) {
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    Count &count = counts_[i], &other = later.counts_[i];
    if (count.count == 0 || other.worst > count.worst) {
      count.worst = other.worst;
      count.example = std::move(other.example);
    }
    count.count += other.count;
  }
  findings_.insert(findings_.end(), std::make_move_iterator(later.findings_.begin()),
                   std::make_move_iterator(later.findings_.end()));
}

std::vector<MapWarning> MapFaults::warnings() const {
  std::vector<MapWarning> warnings;
  for (const MapFaultKind& kind : mapFaultKinds()) {
    const Count& count = counts_[static_cast<std::size_t>(kind.fault)];
    if (count.count == 0) continue;
    const char* introduced = count.worst > 0.0 ? ", the worst: " : ", e.g. ";
    warnings.push_back({text(count.count, " ", kind.what, introduced, count.example), count.count});
  }
  return warnings;
}

}  // namespace external_command
