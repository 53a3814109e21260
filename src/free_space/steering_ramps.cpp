// SPDX-License-Identifier: Apache-2.0
#include "steering_ramps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kStep = 0.05;      ///< of a ramp, that is driven as one arc [m]
constexpr double kRoom = 0.9;       ///< share of the shorter of two arcs that the ramp between them may take
constexpr double kShortArc = 0.15;  ///< arc that is left out for the sake of its neighbours' ramps [m]
constexpr double kShorter = 0.6;    ///< each attempt's ramps, as share of those of the one before
constexpr int kLeastSteps = 4;      ///< of a ramp
constexpr int kAttempts = 12;       ///< the last one's ramps shift nothing by more than hundredths of a millimetre
constexpr int kIterations = 12;
constexpr double kExact = 1e-9;        ///< error of the end, in metres and radians, that is rounding
constexpr double kExactEnough = 1e-5;  ///< the same, that a curve may have
constexpr double kProbe = 1e-6;        ///< step of the numeric derivatives
constexpr double kKappaWeight = 1e-3;  ///< of changes of curvature beside changes of length

using Error = Eigen::Vector3d;

/// Arcs with ramps of given lengths between them, bent back to where the plain ones end.
class Ramps {
 public:
  /// @param arcs  that end about at `goal`.
  Ramps(const Pose2d& from, const Pose2d& goal, double max_kappa, const Arcs& arcs)
      : from_(from), goal_(goal), max_kappa_(max_kappa), arcs_(arcs), lengths_(arcs.size(), 0.0) {}

  /// @param slope  of the curvature on a ramp [1/m^2].
  void setLengths(double slope, double share) {
    for (std::size_t i = 0; i + 1 < arcs_.size(); ++i) {
      if (gearOf(arcs_[i]) != gearOf(arcs_[i + 1])) continue;
      const double wanted = std::abs(arcs_[i + 1].kappa - arcs_[i].kappa) / slope;
      const double room = kRoom * std::min(std::abs(arcs_[i].length), std::abs(arcs_[i + 1].length));
      lengths_[i] = share * std::min(wanted, room);
    }
  }

  /// @return the error that is left at the end.
  double bendBack() {
    double error = endError().norm();
    for (int i = 0; i < kIterations && error > kExact; ++i) {
      const Eigen::VectorXd change = correction();
      if (!change.allFinite()) break;
      const Arcs before = arcs_;
      apply(change);
      const double now = endError().norm();
      if (now >= error) {
        arcs_ = before;
        break;
      }
      error = now;
    }
    return error;
  }

  Arcs refined() const {
    Arcs result;
    for (std::size_t i = 0; i < arcs_.size(); ++i) {
      const double gear = gearOf(arcs_[i]), before = i > 0 ? lengths_[i - 1] / 2.0 : 0.0, after = lengths_[i] / 2.0;
      result.push_back({arcs_[i].length - gear * (before + after), arcs_[i].kappa});
      if (lengths_[i] <= 0.0) continue;
      const int steps = std::max(kLeastSteps, static_cast<int>(std::ceil(lengths_[i] / kStep)));
      const double change = arcs_[i + 1].kappa - arcs_[i].kappa;
      for (int k = 0; k < steps; ++k) {
        result.push_back({gear * lengths_[i] / steps, arcs_[i].kappa + change * (k + 0.5) / steps});
      }
    }
    return result;
  }

 private:
  Error endError() const {
    const Pose2d end = endOf(from_, refined());
    return {end.x - goal_.x, end.y - goal_.y, angleBetween(goal_.heading, end.heading)};
  }

  /// The least change of lengths and curvatures that takes the error out, to first order.
  Eigen::VectorXd correction() {
    const auto count = static_cast<Eigen::Index>(arcs_.size());
    const Error error = endError();
    Eigen::MatrixXd slopes(3, 2 * count);
    Eigen::VectorXd weights(2 * count);
    for (Eigen::Index i = 0; i < 2 * count; ++i) {
      ArcSegment& arc = arcs_[static_cast<std::size_t>(i % count)];
      double& value = i < count ? arc.length : arc.kappa;
      const double old = value;
      value += kProbe;
      slopes.col(i) = (endError() - error) / kProbe;
      value = old;
      weights[i] = i < count ? std::abs(arc.length) : kKappaWeight * max_kappa_;
    }
    const Eigen::MatrixXd weighted = weights.asDiagonal() * slopes.transpose();
    return -weighted * (slopes * weighted).ldlt().solve(error);
  }

  void apply(const Eigen::VectorXd& change) {
    const auto count = static_cast<Eigen::Index>(arcs_.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      ArcSegment& arc = arcs_[static_cast<std::size_t>(i)];
      const double gear = gearOf(arc);
      const double before = i > 0 ? lengths_[static_cast<std::size_t>(i - 1)] / 2.0 : 0.0;
      const double least = before + lengths_[static_cast<std::size_t>(i)] / 2.0;
      arc.length = gear * std::max(gear * (arc.length + change[i]), least);
      arc.kappa = std::clamp(arc.kappa + change[count + i], -max_kappa_, max_kappa_);
    }
  }

  Pose2d from_, goal_;
  double max_kappa_;
  Arcs arcs_;
  std::vector<double> lengths_;  ///< of the ramp after each arc [m]
};

/// Without arcs so short that they would leave no room for ramps; the longest between two gear changes always stays.
Arcs withoutShortArcs(const Arcs& arcs, double shortest) {
  Arcs kept;
  for (auto leg = arcs.begin(); leg != arcs.end();) {
    const auto end = std::find_if(leg, arcs.end(), [&](const ArcSegment& arc) { return gearOf(arc) != gearOf(*leg); });
    const auto shorter = [](const ArcSegment& a, const ArcSegment& b) {
      return std::abs(a.length) < std::abs(b.length);
    };
    const auto longest = std::max_element(leg, end, shorter);
    for (; leg != end; ++leg) {
      if (leg == longest || std::abs(leg->length) >= shortest) kept.push_back(*leg);
    }
  }
  return merged(kept);
}

/// d(steering angle)/d(distance) [rad/m].
double steeringSlope(const VehicleParams& vehicle, const ReferencePoint& a, const ReferencePoint& b) {
  const double turned = std::atan(vehicle.wheelbase * b.kappa) - std::atan(vehicle.wheelbase * a.kappa);
  return std::abs(turned) / std::max(b.s - a.s, 1e-9);
}

}  // namespace

Arcs withSteeringRamps(const Pose2d& from, const Arcs& arcs, const VehicleParams& vehicle, double speed,
                       const std::function<bool(const Arcs&)>& isAllowed) {
  const double slope = vehicle.max_steering_rate / (speed * vehicle.wheelbase);
  double share = 1.0;
  for (int attempt = 1; attempt <= kAttempts; ++attempt, share *= kShorter) {
    Ramps ramps(from, endOf(from, arcs), vehicle.maxKappa(), withoutShortArcs(arcs, share * kShortArc));
    ramps.setLengths(slope, share);
    const double error = ramps.bendBack();
    if (error > kExactEnough) continue;
    Arcs result = ramps.refined();
    if (isAllowed(result)) return result;
  }
  return arcs;
}

void limitSteering(const VehicleParams& vehicle, Path* path) {
  for (std::size_t i = 1; i < path->size(); ++i) {
    ReferencePoint &before = (*path)[i - 1], &point = (*path)[i];
    if (before.direction != point.direction) continue;
    const double slope = steeringSlope(vehicle, before, point);
    const double limit = vehicle.max_steering_rate / std::max(slope, 1e-9);
    before.speed = std::min(before.speed, limit);
    point.speed = std::min(point.speed, limit);
  }
}

}  // namespace external_command
