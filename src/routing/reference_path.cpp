// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/reference_path.h"

#include <algorithm>

#include "external_command/core/parameter_range.h"
#include "external_command/core/text.h"
#include "route_path.h"

namespace external_command {

namespace {

constexpr std::size_t kMostTexts = 20;

}  // namespace

void ReferencePathParams::validate() const {
  requireParameter("path_spacing", spacing, 0.05, 5.0);
  requireParameter("lane_change_length", lane_change_length, 1.0, 500.0);
  requireParameter("default_speed_limit", default_speed_limit, 0.1, 100.0);
}

ReferencePath referencePath(const HdMap& map, const Route& route, const VehicleParams& vehicle,
                            const ReferencePathParams& params, const ReferencePathQuery& query) {
  return routePath({map, vehicle, params}, route, query, nullptr);
}

std::vector<std::string> describe(const HdMap& map, const std::vector<TightLane>& tight, const VehicleParams& vehicle) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(tight.size(), kMostTexts); ++i) {
    texts.push_back(text("lane ", map.lane(tight[i].lane).id, " leaves no room for more than a radius of ",
                         metres(tight[i].radius), " at ", at(tight[i].position), "; the vehicle needs ",
                         metres(vehicle.min_turning_radius), " (~vehicle/min_turning_radius)"));
  }
  if (tight.size() > kMostTexts) texts.push_back(text(tight.size() - kMostTexts, " more lanes bend too tightly"));
  return texts;
}

std::vector<std::string> describe(const HdMap& map, const std::vector<LeftLane>& left) {
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < std::min(left.size(), kMostTexts); ++i) {
    texts.push_back(text("a corner of the vehicle leaves lane ", map.lane(left[i].lane).id, " by ",
                         metres(left[i].excess), " at ", at(left[i].position),
                         ": the lane is too narrow for it there"));
  }
  if (left.size() > kMostTexts) texts.push_back(text(left.size() - kMostTexts, " more lanes are left by a corner"));
  return texts;
}

}  // namespace external_command
