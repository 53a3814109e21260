// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ompl/base/SpaceInformation.h>

#include <cstdint>
#include <memory>

#include "free_space/manoeuvre.h"

namespace ompl::geometric {
class PathGeometric;
}

namespace external_command {

/// OMPL's Reeds-Shepp space over `area` with our state and motion checks: motions are followed in steps along the
/// curve, not along the straight line between their ends. Samples depend on `seed` alone.
ompl::base::SpaceInformationPtr makeSpace(const Scene& scene, const BoundingBox& area, std::uint64_t seed);

Pose2d poseOf(const ompl::base::State* state);
void setPose(const Pose2d& pose, ompl::base::State* state);

/// The curve as states: shortest Reeds-Shepp curves between neighbours give it back.
std::shared_ptr<ompl::geometric::PathGeometric> pathOf(const ompl::base::SpaceInformationPtr& space,
                                                       const Pose2d& start, const Arcs& arcs);

/// The shortest Reeds-Shepp curves from state to state.
Arcs arcsOf(const ompl::geometric::PathGeometric& path, double radius);

}  // namespace external_command
