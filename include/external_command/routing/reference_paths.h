// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "external_command/routing/reference_path.h"

namespace external_command {

struct SectionMemory;

/// Reference paths of one map and vehicle, that remember what they are made of: the smooth pieces between calm places
/// of lanes (where the vehicle is asked for nothing, some 25 m apart) that routes have in common. Only the ways from
/// the start and to the goal, from and to the next such place, and lane changes are made anew for each path. At most
/// 400,000 points are kept, 22 MB, and the calm places of some 100,000 lanes, 10 MB: what was not asked for for longest
/// goes first. Thread-safe; no lock is held while anything is computed.
class ReferencePaths {
 public:
  /// One for all of this process that have map, vehicle and parameters in common. Lives as long as one of them.
  static std::shared_ptr<const ReferencePaths> acquire(const std::shared_ptr<const HdMap>& map,
                                                       const VehicleParams& vehicle, const ReferencePathParams& params);

  ReferencePaths(std::shared_ptr<const HdMap> map, const VehicleParams& vehicle, const ReferencePathParams& params);
  ~ReferencePaths();

  /// The same path as referencePath().
  /// @throws NoPath, Cancelled  as that does.
  ReferencePath find(const Route& route, const ReferencePathQuery& query) const;

  /// How many points are kept.
  std::size_t kept() const;

 private:
  bool areFor(const HdMap& map, const VehicleParams& vehicle, const ReferencePathParams& params) const;

  const std::shared_ptr<const HdMap> map_;
  const VehicleParams vehicle_;
  const ReferencePathParams params_;
  const std::unique_ptr<SectionMemory> memory_;
};

}  // namespace external_command
