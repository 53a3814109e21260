// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/pose.h"

namespace external_command {

/// A place of a path that may move along its normal. Offsets [m] are measured along `normal` from `base`.
struct FitPoint {
  Point2d base = Point2d::Zero();
  Point2d normal = Point2d::Zero();            ///< of length 1, to the left of the way
  double center = 0.0;                         ///< where it would like to be
  double low = 0.0, high = 0.0;                ///< between which it stays
  double wished_low = 0.0, wished_high = 0.0;  ///< beyond which it goes only for the sake of the vehicle's limits
  bool fixed = false;                          ///< it stays on `base`
};

struct FitParams {
  double step = 0.5;        ///< between two places, about [m]
  double max_kappa = 0.2;   ///< [1/m]
  double max_change = 0.1;  ///< of the curvature, as fast as the wheels can be turned at a crawl [1/m^2]
  double front = 3.75;      ///< from the reference point to the vehicle's front [m]
  double rear = 0.95;       ///< and to its rear, positive [m]
};

/// Moves the places of a path so that its curvature is within the limit, and changes slowly, and the middle of the
/// vehicle's front and rear stay between the limits as well, as far as all that goes together. The reference point
/// stays within its limits first of all; then the curvature counts, then front and rear, then the wishes.
///
/// The sum of squares of the distances from the centre, of the change of curvature per metre, and of what exceeds a
/// limit, each with its weight, is minimized by Gauss-Newton steps (Nocedal and Wright, Numerical Optimization, 10.3);
/// each neighbour thrice removed has a share in a residual at most, so that a step is one banded factorization, O(n).
class PathFit {
 public:
  PathFit(std::vector<FitPoint> places, const FitParams& params);

  /// @throws Cancelled
  void run(const CancelToken& cancel);

  /// The places as they lie now.
  const std::vector<Point2d>& points() const { return points_; }

 private:
  static constexpr std::size_t kBand = 3;  ///< off-diagonals of the system of equations
  using Row = std::array<double, kBand + 1>;

  /// Curvature at a place, and how it changes with the offsets of the place before, this one, and the one after.
  struct Bend {
    double kappa = 0.0;
    std::array<double, 3> slopes{};
  };

  /// One end of the vehicle: how far ahead of the reference point it is.
  struct End {
    End(double metres_ahead, double step);
    double ahead;            ///< [m]
    double places;           ///< the same in places
    std::ptrdiff_t abreast;  ///< to the nearest place
  };

  void place(const std::vector<double>& offsets);
  void measureBends();
  double buildSystem();
  void hold();
  void solve();
  template <class Visitor>
  void visitResiduals(Visitor&& visit) const;
  template <class Visitor>
  void visitBody(std::size_t i, const End& end, Visitor&& visit) const;

  std::vector<FitPoint> places_;
  FitParams params_;
  End front_, rear_;
  std::vector<double> offsets_, step_;
  std::vector<Point2d> points_;
  std::vector<Bend> bends_;
  std::vector<Row> rows_;  ///< of the symmetric system: the diagonal, then what stands left of it, the nearest first
};

}  // namespace external_command
