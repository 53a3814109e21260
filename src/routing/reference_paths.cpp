// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/reference_paths.h"

#include <algorithm>
#include <mutex>
#include <utility>
#include <vector>

#include "route_path.h"

namespace external_command {

std::shared_ptr<const ReferencePaths> ReferencePaths::acquire(const std::shared_ptr<const HdMap>& map,
                                                              const VehicleParams& vehicle,
                                                              const ReferencePathParams& params) {
  static std::mutex mutex;
  static std::vector<std::weak_ptr<const ReferencePaths>> live;
  const std::lock_guard<std::mutex> lock(mutex);
  const auto has_gone = [](const std::weak_ptr<const ReferencePaths>& paths) { return paths.expired(); };
  live.erase(std::remove_if(live.begin(), live.end(), has_gone), live.end());
  for (const std::weak_ptr<const ReferencePaths>& known : live) {
    const std::shared_ptr<const ReferencePaths> paths = known.lock();
    if (paths && paths->areFor(*map, vehicle, params)) return paths;
  }
  const auto made = std::make_shared<const ReferencePaths>(map, vehicle, params);
  live.push_back(made);
  return made;
}

ReferencePaths::ReferencePaths(std::shared_ptr<const HdMap> map, const VehicleParams& vehicle,
                               const ReferencePathParams& params)
    : map_(std::move(map)), vehicle_(vehicle), params_(params), memory_(std::make_unique<SectionMemory>()) {}

ReferencePaths::~ReferencePaths() = default;

ReferencePath ReferencePaths::find(const Route& route, const ReferencePathQuery& query) const {
  return routePath({*map_, vehicle_, params_}, route, query, memory_.get());
}

/// Compares what paths depend on.
bool ReferencePaths::areFor(const HdMap& map, const VehicleParams& vehicle, const ReferencePathParams& params) const {
  return &map == map_.get() && vehicle.wheelbase == vehicle_.wheelbase && vehicle.width == vehicle_.width &&
         vehicle.front_overhang == vehicle_.front_overhang && vehicle.rear_overhang == vehicle_.rear_overhang &&
         vehicle.min_turning_radius == vehicle_.min_turning_radius &&
         vehicle.max_steering_rate == vehicle_.max_steering_rate && params.spacing == params_.spacing &&
         params.lane_change_length == params_.lane_change_length &&
         params.default_speed_limit == params_.default_speed_limit &&
         params.refuse_undrivable == params_.refuse_undrivable;
}

std::size_t ReferencePaths::kept() const { return memory_->paths.sum(); }

}  // namespace external_command
