// SPDX-License-Identifier: Apache-2.0
#include "connector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"
#include "turns.h"

namespace external_command {

namespace {

constexpr std::array<double, 2> kBacked = {0.4, 1.0};  ///< shares of a swath that are backed along
constexpr double kRoom = 8.0;               ///< around both ends that a search looks at first, in turning radii
constexpr double kMostGearPrice = 1000.0;   ///< that a search takes [m]
constexpr double kMostSearching = 0.5;      ///< [s]
constexpr unsigned kMostSteps = 2500;       ///< of a search; a swath that is harder to get to is not worth it
constexpr double kTimeForSearching = 0.92;  ///< share of the budget after which only short turns are looked for

}  // namespace

std::optional<Curve> Connector::connect(const Curve* driven, const Pose2d& from, const Curve& next) {
  if (driven == nullptr && !field_.isFree(from)) return leave(from, next.start);
  if (auto curve = turn(from, next.start)) return curve;
  for (const double share : kBacked) {
    if (driven != nullptr) {
      const double length = driven->length();
      Curve curve = backedUp(partOf(*driven, (1.0 - share) * length, length));
      if (const auto rest = turn(curve.end(), next.start)) {
        curve.append(rest->arcs);
        return curve;
      }
    }
    const Curve begin = partOf(next, 0.0, share * next.length());
    if (auto curve = turn(from, begin.end())) {
      curve->append(backedUp(begin).arcs);
      return curve;
    }
  }
  return std::nullopt;
}

std::optional<Curve> Connector::turn(const Pose2d& from, const Pose2d& to) {
  field_.poll();
  const std::array<double, 6> ends{from.x, from.y, from.heading, to.x, to.y, to.heading};
  const auto known = turns_.find(ends);
  if (known != turns_.end()) return known->second;
  return turns_.emplace(ends, newTurn(from, to)).first->second;
}

std::optional<Curve> Connector::newTurn(const Pose2d& from, const Pose2d& to) const {
  if (auto curve = shortTurn(field_, from, to)) return curve;
  if (field_.timeUsed() > kTimeForSearching) return std::nullopt;
  if (auto curve = shiftedTurn(field_, from, to)) return curve;
  return search(from, to);
}

std::optional<Curve> Connector::leave(const Pose2d& from, const Pose2d& to) const {
  field_.poll();
  return field_.isFree(to) ? searchNearAndFar(from, to) : std::nullopt;
}

std::optional<Curve> Connector::search(const Pose2d& from, const Pose2d& to) const {
  if (!field_.isFree(from) || !field_.isFree(to)) return std::nullopt;  // the planner would ease the margin there
  return searchNearAndFar(from, to);
}

/// Nearby first: most ways lead no farther, and to prepare for the whole area takes longer than to search.
std::optional<Curve> Connector::searchNearAndFar(const Pose2d& from, const Pose2d& to) const {
  const double room = kRoom * field_.radius();
  const Point2d low = from.position().cwiseMin(to.position()) - Point2d(room, room);
  const Point2d high = from.position().cwiseMax(to.position()) + Point2d(room, room);
  if (auto curve = searchWithin(BoundingBox{low, high}, from, to)) return curve;
  return searchWithin(std::nullopt, from, to);
}

std::optional<Curve> Connector::searchWithin(const std::optional<BoundingBox>& box, const Pose2d& from,
                                             const Pose2d& to) const {
  Region::Parts parts;
  parts.drivable = field_.region().drivable();
  parts.non_drivable = field_.region().nonDrivable();
  parts.axle_bounds = box;
  FreeSpaceParams params;
  params.planner = "hybrid_astar";
  params.margin = field_.params().margin;
  params.time_budget = std::clamp((1.0 - field_.timeUsed()) * field_.params().time_budget, 1e-3, kMostSearching);
  params.max_iterations = kMostSteps;
  params.improve_budget = 0.0;
  params.gear_change_cost = std::min(field_.gearPrice(), kMostGearPrice);
  params.reverse_factor = 1.0;  // a metre swept is a metre, in either gear
  params.continuous_curvature = false;
  params.spacing = 0.25;
  try {
    const FreeSpacePlan result =
        FreeSpacePlanner(field_.vehicle(), params).plan(from, {to}, Region(std::move(parts)), field_.cancel());
    Curve curve{from, {}};
    for (std::size_t i = 1; i < result.path.size(); ++i) {
      const ReferencePoint& point = result.path[i];
      const double length = point.s - result.path[i - 1].s;
      curve.append({signOf(point.direction) * length, point.kappa});
    }
    return curve;
  } catch (const Cancelled&) {
    throw;
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace external_command
