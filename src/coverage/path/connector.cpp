// SPDX-License-Identifier: Apache-2.0
#include "connector.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/free_space/free_space_planner.h"

namespace external_command {

namespace {

/// How far before or beyond its ends a turn may begin and end, in turning radii: straight on, or backing up.
constexpr std::array<double, 11> kShifts = {0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 1.6, -1.6, 2.5, -2.5};
constexpr double kLongest = 4.0;      ///< how much dearer than the cheapest a turn may be, in turning radii
constexpr double kMostChanges = 4.0;  ///< and how many changes of gear on top of that
constexpr std::size_t kMostTried = 600;
constexpr std::array<double, 2> kBacked = {0.4, 1.0};  ///< shares of a swath that are backed along
constexpr double kRoom = 8.0;              ///< around both ends that a search looks at first, in turning radii
constexpr double kMostGearPrice = 1000.0;  ///< that a search takes [m]
constexpr double kMostSearching = 0.5;     ///< [s]
constexpr unsigned kMostSteps = 2500;      ///< of a search; a swath that is harder to get to is not worth it

struct Candidate {
  double cost = 0.0;
  double before = 0.0;  ///< driven straight on first [m]
  double after = 0.0;   ///< driven straight on last [m]
  std::vector<ArcSegment> arcs;
};

Pose2d straightOn(const Pose2d& pose, double length) { return advance(pose, ArcSegment{length, 0.0}); }

Curve curveOf(const Pose2d& from, const Candidate& candidate) {
  Curve curve{from, {}};
  curve.append({candidate.before, 0.0});
  curve.append(candidate.arcs);
  curve.append({candidate.after, 0.0});
  return curve;
}

}  // namespace

std::vector<SteeringCurve> turnsWithoutObstacles(const Pose2d& from, const Pose2d& to, double radius,
                                                 double gear_price) {
  std::vector<SteeringCurve> turns = reedsSheppCurves(from, to, radius, gear_price);
  for (SteeringCurve& turn : turns) {
    if (turn.arcs.empty()) continue;
    turn.cost += gear_price * ((turn.arcs.front().length < 0.0) + (turn.arcs.back().length < 0.0));
  }
  for (SteeringCurve& turn : dubinsCurves(from, to, radius)) turns.push_back(std::move(turn));
  std::stable_sort(turns.begin(), turns.end(),
                   [](const SteeringCurve& a, const SteeringCurve& b) { return a.cost < b.cost; });
  return turns;
}

std::optional<Curve> Connector::connect(const Curve* driven, const Pose2d& from, const Curve& next) const {
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

std::optional<Curve> Connector::turn(const Pose2d& from, const Pose2d& to) const {
  field_.poll();
  if (auto curve = shortTurn(from, to)) return curve;
  if (auto curve = shiftedTurn(from, to)) return curve;
  return search(from, to);
}

std::optional<Curve> Connector::shortTurn(const Pose2d& from, const Pose2d& to) const {
  const auto curves = turnsWithoutObstacles(from, to, field_.radius(), field_.gearPrice());
  const double most = curves.front().cost + 0.5 * field_.radius();
  for (const SteeringCurve& steering : curves) {
    if (steering.cost > most) break;
    Curve curve{from, {}};
    curve.append(steering.arcs);
    if (field_.isFree(curve)) return curve;
  }
  return std::nullopt;
}

std::optional<Curve> Connector::shiftedTurn(const Pose2d& from, const Pose2d& to) const {
  std::vector<Candidate> candidates;
  const double price = field_.gearPrice();
  const double most = turnsWithoutObstacles(from, to, field_.radius(), price).front().cost +
                      kLongest * field_.radius() + kMostChanges * price;
  for (const double first : kShifts) {
    const double before = first * field_.radius();
    const Pose2d begin = straightOn(from, before);
    if (!field_.isFree(begin)) continue;
    for (const double last : kShifts) {
      const double after = last * field_.radius();
      const Pose2d end = straightOn(to, -after);
      const double shifted = std::abs(before) + std::abs(after);
      if (shifted + (end.position() - begin.position()).norm() > most || !field_.isFree(end)) continue;
      for (SteeringCurve& steering : turnsWithoutObstacles(begin, end, field_.radius(), price)) {
        if (steering.cost + shifted > most) break;
        Candidate candidate{0.0, before, after, std::move(steering.arcs)};
        const Curve curve = curveOf(from, candidate);
        candidate.cost = curve.length() + price * curve.gearChangesBetween();
        candidates.push_back(std::move(candidate));
      }
    }
  }
  const auto cheaper = [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; };
  std::sort(candidates.begin(), candidates.end(), cheaper);
  if (candidates.size() > kMostTried) candidates.resize(kMostTried);
  for (const Candidate& candidate : candidates) {
    Curve curve = curveOf(from, candidate);
    if (field_.isFree(curve)) return curve;
  }
  return std::nullopt;
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
