// SPDX-License-Identifier: Apache-2.0
#include "map_faults.h"

namespace external_command {

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
