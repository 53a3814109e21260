// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/reference_paths.h"

#include <utility>

#include "route_path.h"

namespace external_command {

ReferencePaths::ReferencePaths(std::shared_ptr<const HdMap> map, const VehicleParams& vehicle,
                               const ReferencePathParams& params)
    : map_(std::move(map)), vehicle_(vehicle), params_(params), memory_(std::make_unique<SectionMemory>()) {}

ReferencePaths::~ReferencePaths() = default;

ReferencePath ReferencePaths::find(const Route& route, const ReferencePathQuery& query) const {
  return routePath({*map_, vehicle_, params_}, route, query, memory_.get());
}

std::size_t ReferencePaths::kept() const { return memory_->paths.sum(); }

}  // namespace external_command
