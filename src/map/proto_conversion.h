// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/map/map_data.h"
#include "external_command/proto/base_map.pb.h"

namespace external_command {

/// Gathers what the parts of a map file state, in this package's own terms. A lane of an unknown type becomes kNone, so
/// that nothing drives on it; one without a type counts as a driving lane.
class ProtoConverter {
 public:
  void add(const proto::Map& part);

  /// Everything added; call it once, at the end.
  MapData take() { return std::move(data_); }

  /// What several gathered, from one part of the file after the other.
  static MapData takeAll(std::vector<ProtoConverter> parts);

 private:
  void addLane(const proto::Lane& message);
  void addRoad(const proto::Road& message);
  void addOverlap(const proto::Overlap& message);

  MapData data_;
};

}  // namespace external_command
