// SPDX-License-Identifier: Apache-2.0
#include "path_fit.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

// Weights of the squares. A metre off the centre counts 1; the others follow from what they are to outweigh.
constexpr double kChange = 64.0;    // of the change of curvature [m^4]: details of less than some 2 m are smoothed out
constexpr double kWish = 20.0;      // beyond the own lane
constexpr double kBody = 50.0;      // front or rear beyond the limits
constexpr double kCurvature = 1e5;  // beyond the limit [m^2]
constexpr double kTooFast = 1e4;    // change of curvature beyond its limit [m^4]
constexpr double kLimit = 5e5;      // reference point beyond its limits
constexpr double kCenter = 1.0;
constexpr double kDamping = 1e-3;     // keeps the system regular
constexpr int kSteps = 40;            // at most
constexpr int kHalvings = 6;          // of a step that does not lower the cost
constexpr double kSettled = 2e-3;     // largest move of a last step [m]
constexpr double kLargestMove = 0.6;  // of a place in one step [m]
constexpr double kShortRear = 1.5;    // of which nothing needs to be known [m]

double beyond(double value, double low, double high) {
  return value > high ? value - high : value < low ? value - low : 0.0;
}

}  // namespace

PathFit::End::End(double metres_ahead, double step)
    : ahead(metres_ahead), places(ahead / step), abreast(static_cast<std::ptrdiff_t>(std::floor(places + 0.5))) {}

PathFit::PathFit(std::vector<FitPoint> places, const FitParams& params)
    : places_(std::move(places)),
      params_(params),
      front_(params.front, params.step),
      rear_(-params.rear, params.step),
      offsets_(places_.size(), 0.0),
      step_(places_.size(), 0.0),
      points_(places_.size()),
      bends_(places_.size()),
      rows_(places_.size()) {
  place(offsets_);
}

void PathFit::place(const std::vector<double>& offsets) {
  for (std::size_t i = 0; i < places_.size(); ++i) points_[i] = places_[i].base + offsets[i] * places_[i].normal;
  measureBends();
}

void PathFit::measureBends() {
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const Point2d a = points_[i] - points_[i - 1], b = points_[i + 1] - points_[i], c = a + b;
    const double aa = std::max(a.squaredNorm(), 1e-12), bb = std::max(b.squaredNorm(), 1e-12);
    const double cc = std::max(c.squaredNorm(), 1e-12);
    const double scale = 2.0 / std::sqrt(aa * bb * cc);  // Menger: twice the cross product by the sides' product
    const Point2d &before = places_[i - 1].normal, &here = places_[i].normal, &after = places_[i + 1].normal;
    Bend& bend = bends_[i];
    bend.kappa = scale * cross(a, b);
    bend.slopes[0] = -scale * cross(before, b) + bend.kappa * (a.dot(before) / aa + c.dot(before) / cc);
    bend.slopes[1] = scale * cross(here, c) + bend.kappa * (b.dot(here) / bb - a.dot(here) / aa);
    bend.slopes[2] = scale * cross(a, after) - bend.kappa * (b.dot(after) / bb + c.dot(after) / cc);
  }
}

/// The middle of the vehicle's end at place `i`, beyond the limits where it is.
template <class Visitor>
void PathFit::visitBody(std::size_t i, const End& end, Visitor&& visit) const {
  const double station = static_cast<double>(i) + end.places;
  if (station < 0.0 || station > static_cast<double>(places_.size() - 1)) return;
  const FitPoint& there = places_[static_cast<std::size_t>(static_cast<std::ptrdiff_t>(i) + end.abreast)];
  const Point2d way = points_[i + 1] - points_[i - 1];
  const double lever = end.ahead / std::max(way.norm(), 1e-6);
  const double offset = (points_[i] + lever * way - there.base).dot(there.normal);
  const double excess = beyond(offset, there.low, there.high);
  if (excess == 0.0) return;
  const std::array<double, 3> slopes = {-lever * places_[i - 1].normal.dot(there.normal),
                                        places_[i].normal.dot(there.normal),
                                        lever * places_[i + 1].normal.dot(there.normal)};
  visit(kBody, excess, i - 1, slopes);
}

/// Calls visit(weight, residual, index of the first place with a share in it, slopes by the offsets from there on).
template <class Visitor>
void PathFit::visitResiduals(Visitor&& visit) const {
  const std::array<double, 1> one = {1.0};
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const FitPoint& place = places_[i];
    visit(kCenter, offsets_[i] - place.center, i, one);
    if (const double excess = beyond(offsets_[i], place.low, place.high)) visit(kLimit, excess, i, one);
    if (const double excess = beyond(offsets_[i], place.wished_low, place.wished_high)) visit(kWish, excess, i, one);
    if (i == 0 || i + 1 >= places_.size()) continue;
    const Bend& bend = bends_[i];
    if (const double excess = beyond(bend.kappa, -params_.max_kappa, params_.max_kappa)) {
      visit(kCurvature, excess, i - 1, bend.slopes);
    }
    visitBody(i, front_, visit);
    if (params_.rear > kShortRear) visitBody(i, rear_, visit);
    if (i + 2 >= places_.size()) continue;
    const Bend& next = bends_[i + 1];
    const std::array<double, 4> slopes = {
        -bend.slopes[0] / params_.step, (next.slopes[0] - bend.slopes[1]) / params_.step,
        (next.slopes[1] - bend.slopes[2]) / params_.step, next.slopes[2] / params_.step};
    const double change = (next.kappa - bend.kappa) / params_.step;
    visit(kChange, change, i - 1, slopes);
    if (const double excess = beyond(change, -params_.max_change, params_.max_change)) {
      visit(kTooFast, excess, i - 1, slopes);
    }
  }
}

/// At the places as they lie now. @return  the cost there
double PathFit::buildSystem() {
  std::fill(rows_.begin(), rows_.end(), Row{});
  std::fill(step_.begin(), step_.end(), 0.0);
  double cost = 0.0;
  visitResiduals([&](double weight, double residual, std::size_t first, const auto& slopes) {
    cost += weight * residual * residual;
    for (std::size_t k = 0; k < slopes.size(); ++k) {
      step_[first + k] -= weight * slopes[k] * residual;
      for (std::size_t m = 0; m <= k; ++m) rows_[first + k][m] += weight * slopes[k] * slopes[k - m];
    }
  });
  return cost;
}

/// Keeps the system regular, and the fixed places where they are.
void PathFit::hold() {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    rows_[i][0] += kDamping;
    if (!places_[i].fixed) continue;
    rows_[i] = Row{1.0};
    for (std::size_t k = 1; k <= kBand && i + k < rows_.size(); ++k) rows_[i + k][k] = 0.0;
    step_[i] = 0.0;
  }
}

/// L D L^T of the rows, in place, and the step from the right-hand side.
void PathFit::solve() {
  const std::size_t count = rows_.size();
  for (std::size_t i = 0; i < count; ++i) {
    Row& row = rows_[i];
    for (std::size_t k = std::min(i, kBand); k >= 1; --k) {
      const Row& other = rows_[i - k];
      for (std::size_t m = k + 1; m <= std::min(i, kBand); ++m) row[k] -= row[m] * other[m - k] * rows_[i - m][0];
      row[k] /= other[0];
      row[0] -= row[k] * row[k] * other[0];
    }
    for (std::size_t k = 1; k <= std::min(i, kBand); ++k) step_[i] -= row[k] * step_[i - k];
  }
  for (std::size_t i = 0; i < count; ++i) step_[i] /= rows_[i][0];
  for (std::size_t i = count; i-- > 0;) {
    for (std::size_t k = 1; k <= std::min(count - 1 - i, kBand); ++k) step_[i] -= rows_[i + k][k] * step_[i + k];
  }
}

void PathFit::run(const CancelToken& cancel) {
  double now = buildSystem();
  for (int round = 0; round < kSteps; ++round) {
    cancel.throwIfCancelled();
    hold();
    solve();
    double largest = 0.0;
    for (const double move : step_) largest = std::max(largest, std::abs(move));
    if (!std::isfinite(largest)) break;
    double share = std::min(1.0, kLargestMove / std::max(largest, 1e-9));
    const std::vector<double> before = offsets_, step = step_;
    bool is_better = false;
    for (int halving = 0; halving < kHalvings && !is_better; ++halving, share *= 0.5) {
      for (std::size_t i = 0; i < offsets_.size(); ++i) offsets_[i] = before[i] + share * step[i];
      place(offsets_);
      const double then = buildSystem();
      is_better = then < now;
      if (is_better) now = then;
    }
    if (!is_better) {
      offsets_ = before;
      place(offsets_);
      break;
    }
    if (share * 2.0 * largest < kSettled) break;
  }
}

}  // namespace external_command
