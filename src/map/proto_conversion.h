// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "external_command/map/map_data.h"
#include "external_command/proto/base_map.pb.h"
#include "warning_counter.h"

namespace external_command {

/// Gathers what the parts of a map file state, in this package's own terms. A lane of an unknown type becomes kNone, so
/// that nothing drives on it; one without a type counts as a driving lane. Both are counted in the warnings.
class ProtoConverter {
 public:
  void add(const proto::Map& part);

  /// Everything added; call it once, at the end.
  MapData take();

 private:
  void addLane(const proto::Lane& message);
  LaneType laneTypeOf(const proto::Lane& message);
  void addRoad(const proto::Road& message);
  void addOverlap(const proto::Overlap& message);

  MapData data_;
  WarningCounter unknown_types_{"lanes of a type that is not known; nothing drives on them"};
  WarningCounter no_types_{"lanes without a type, taken as driving lanes"};
};

}  // namespace external_command
