// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/arrival.h"

#include <cmath>

#include "external_command/core/parameter_range.h"

namespace external_command {

namespace {

constexpr double kStanding = 0.05;  // a vehicle that moved less stands; localization is noisy [m]
constexpr double kWindow = 0.5;     // over which the speed is taken [s]
constexpr double kGap = 1.0;        // after which poses tell nothing of the speed between them [s]

double distance(const Pose2d& a, const Pose2d& b) { return (a.position() - b.position()).norm(); }

}  // namespace

void ArrivalParams::validate() const {
  requireParameter("along", along, 0.01, 100.0);
  requireParameter("across", across, 0.01, 100.0);
  requireParameter("heading", heading, 0.001, M_PI);
  requireParameter("rest", rest, 0.0, 3600.0);
}

void VehicleMotion::update(const Pose2d& pose, double now) {
  if (!is_known_ || distance(pose, anchor_.pose) > kStanding) {
    anchor_ = {pose, now};
    moved_at_ = now;
  }
  if (!is_known_ || now - window_.time > kWindow + kGap) {
    window_ = {pose, now};
    speed_ = 0.0;
  }
  is_known_ = true;
  if (now - window_.time < kWindow) return;
  speed_ = distance(pose, window_.pose) / (now - window_.time);
  window_ = {pose, now};
}

EndError endError(const Pose2d& vehicle, const ReferencePoint& end) {
  const Pose2d relative = relativeTo(end.pose(), vehicle);
  const double sign = signOf(end.direction);
  return {sign * relative.x, relative.y, relative.heading};
}

bool isWithin(const EndError& error, const ArrivalParams& params) {
  return std::abs(error.along) <= params.along && std::abs(error.across) <= params.across &&
         std::abs(error.heading) <= params.heading;
}

}  // namespace external_command
