// SPDX-License-Identifier: Apache-2.0
#include "gradual_link.h"

#include <algorithm>
#include <cmath>

#include "free_space/steering_ramps.h"

namespace external_command {

namespace {

constexpr double kMostOfLine = 0.4;  ///< that may be bent at either end, as share of its length
constexpr double kStep = 0.2;        ///< of a ramp, that is one arc [m]
constexpr double kMostTime = 0.9;    ///< of the budget, after which ways stay as they are

/// No bend can be driven faster, and no ramp needs to be longer, than the lateral acceleration allows [m/s].
double speedOf(const Field& field) {
  const VehicleParams& vehicle = field.vehicle();
  return std::min(
      {field.params().turn_speed, vehicle.max_speed, std::sqrt(vehicle.max_lateral_acceleration / vehicle.maxKappa())});
}

bool isReverse(const ArcSegment& arc) { return arc.length < 0.0; }

}  // namespace

GradualLink gradualLink(const Field& field, const Curve* before, const Curve& link, const Curve& after) {
  const double speed = speedOf(field), ramp = field.vehicle().rampLength(speed);
  GradualLink result{link, 0.0, 0.0};
  if (ramp <= 0.0 || link.arcs.empty() || field.timeUsed() > kMostTime) return result;
  // A ramp lies half on either side of a jump, and takes no more than 0.9 of an arc.
  Curve curve{link.start, {}};
  if (before != nullptr && !isReverse(link.arcs.front())) {
    const double length = before->length();
    result.before = std::min(ramp, kMostOfLine * length);
    curve = partOf(*before, length - result.before, length);
  }
  curve.append(link.arcs);
  if (!isReverse(link.arcs.back())) {
    result.after = std::min(ramp, kMostOfLine * after.length());
    curve.append(partOf(after, 0.0, result.after).arcs);
  }
  const bool keeps_margin = field.isFree(curve);
  const auto is_allowed = [&](const Pose2d& from, const std::vector<ArcSegment>& arcs) {
    const Curve part{from, arcs};
    return keeps_margin ? field.isFree(part) : field.isBarelyFree(part);
  };
  const auto stop = [&] { return field.timeUsed() > kMostTime; };
  const RampShape shape{speed, kStep};
  result.curve = {curve.start,
                  *withSteeringRamps(curve.start, curve.arcs, {}, field.vehicle(), shape, is_allowed, stop)};
  return result;
}

}  // namespace external_command
