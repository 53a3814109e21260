// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>

#include "no_way.h"
#include "two_way_search.h"

namespace external_command {

/// Steps that find the first path nearly always. With more allowed, the stages after the first are gone through.
constexpr std::size_t kFirstLookSteps = 4000;

struct FirstPath {
  TwoWaySearch::Outcome outcome = TwoWaySearch::Outcome::kStopped;
  Arcs arcs;                    ///< of kFound
  std::optional<NoWay> no_way;  ///< the proof that kNone rests on; nullopt where the search came to its end
};

/// A little of TwoWaySearch, which suffices nearly always; then, unless something is proved to be too tight for the
/// vehicle, WayPoseSearch where the way is long; then more of TwoWaySearch, ShuffleSearch where the tight place lies
/// between start and goal, and TwoWaySearch to its end: out of a tight end it finds a cheaper way than shuffling does.
/// @param area       the rear axle stays inside while searching.
/// @param max_steps  of TwoWaySearch; the other stages have bounds of their own, and are left out where these are few.
/// @param stop       asked after every step.
FirstPath searchInStages(const Scene& scene, const Query& query, const BoundingBox& area, std::size_t max_steps,
                         const std::function<bool()>& stop);

}  // namespace external_command
