// SPDX-License-Identifier: Apache-2.0
#include "steering_ramps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace external_command {

namespace {

constexpr double kRoom = 0.9;          ///< share of the shorter of two arcs that the ramp between them may take
constexpr double kShortArc = 0.15;     ///< arc that is left out for the sake of its neighbours' ramps [m]
constexpr double kShorter = 0.6;       ///< each attempt's ramps, as share of those of the one before
constexpr int kLeastSteps = 4;         ///< of a ramp
constexpr int kAttempts = 12;          ///< the last one's ramps shift nothing by more than hundredths of a millimetre
constexpr std::size_t kPartArcs = 12;  ///< of a part of the way that gets its ramps apart from others; up to twice that
constexpr int kIterations = 12;
constexpr double kExact = 1e-9;        ///< error of the end, in metres and radians, that is rounding
constexpr double kExactEnough = 1e-5;  ///< the same, that a curve may have
constexpr double kProbe = 1e-6;        ///< step of the numeric derivatives
constexpr double kKappaWeight = 1e-3;  ///< of changes of curvature beside changes of length

using Error = Eigen::Vector3d;

/// Of curvatures and ramps.
struct Limits {
  double max_kappa;  ///< [1/m]
  double slope;      ///< of the curvature on a ramp [1/m^2]
  double step;       ///< of a ramp, that is one arc [m]
};

/// Arcs with ramps of given lengths between them, bent back to where the plain ones end.
class Ramps {
 public:
  /// @param arcs  that end about at `goal`.
  Ramps(const Pose2d& from, const Pose2d& goal, const Limits& limits, const Arcs& arcs)
      : from_(from), goal_(goal), limits_(limits), arcs_(arcs), lengths_(arcs.size(), 0.0) {}

  const Pose2d& from() const { return from_; }

  /// How many ramps there may be; some have no length.
  std::size_t size() const { return arcs_.empty() ? 0 : arcs_.size() - 1; }

  void setLengths(double share) {
    for (std::size_t i = 0; i < size(); ++i) lengths_[i] = share * wantedLength(i);
  }

  double length(std::size_t i) const { return lengths_[i]; }
  void setLength(std::size_t i, double length) { lengths_[i] = length; }

  double wantedLength(std::size_t i) const {
    if (gearOf(arcs_[i]) != gearOf(arcs_[i + 1])) return 0.0;
    const double wanted = std::abs(arcs_[i + 1].kappa - arcs_[i].kappa) / limits_.slope;
    return std::min(wanted, kRoom * std::min(std::abs(arcs_[i].length), std::abs(arcs_[i + 1].length)));
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
      forEachPiece(i, [&](const ArcSegment& piece) { result.push_back(piece); });
    }
    return result;
  }

 private:
  /// Calls `visit` with what is left of arc `i`, then with the pieces of the ramp after it.
  template <class Visit>
  void forEachPiece(std::size_t i, const Visit& visit) const {
    const double gear = gearOf(arcs_[i]), before = i > 0 ? lengths_[i - 1] / 2.0 : 0.0, after = lengths_[i] / 2.0;
    visit(ArcSegment{arcs_[i].length - gear * (before + after), arcs_[i].kappa});
    if (lengths_[i] <= 0.0) return;
    const int steps = std::max(kLeastSteps, static_cast<int>(std::ceil(lengths_[i] / limits_.step)));
    const double change = arcs_[i + 1].kappa - arcs_[i].kappa;
    for (int k = 0; k < steps; ++k) {
      visit(ArcSegment{gear * lengths_[i] / steps, arcs_[i].kappa + change * (k + 0.5) / steps});
    }
  }

  Pose2d after(std::size_t i, Pose2d pose) const {
    forEachPiece(i, [&](const ArcSegment& piece) { pose = advance(pose, piece); });
    return pose;
  }

  Error errorOf(const Pose2d& end) const {
    return {end.x - goal_.x, end.y - goal_.y, angleBetween(goal_.heading, end.heading)};
  }

  Error endError() const {
    Pose2d pose = from_;
    for (std::size_t i = 0; i < arcs_.size(); ++i) pose = after(i, pose);
    return errorOf(pose);
  }

  /// The least change of lengths and curvatures that takes the error out, to first order, and leaves both within
  /// bounds.
  Eigen::VectorXd correction() {
    const std::size_t count = arcs_.size();
    std::vector<Pose2d> begins{from_};
    for (std::size_t i = 0; i < count; ++i) begins.push_back(after(i, begins.back()));
    const Pose2d end = begins.back();
    const Error error = errorOf(end);
    Eigen::MatrixXd slopes(3, 2 * static_cast<Eigen::Index>(count));
    Eigen::VectorXd weights(slopes.cols());
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t first = i > 0 ? i - 1 : 0;  // the ramp before the arc changes with its curvature
      const Pose2d rest = relativeTo(begins[i + 1], end);
      const auto probe = [&](double* value, double weight, std::size_t column) {
        const double old = *value;
        *value += kProbe;
        Pose2d pose = begins[first];
        for (std::size_t k = first; k <= i; ++k) pose = after(k, pose);
        *value = old;
        slopes.col(static_cast<Eigen::Index>(column)) = (errorOf(compose(pose, rest)) - error) / kProbe;
        weights[static_cast<Eigen::Index>(column)] = weight;
      };
      probe(&arcs_[i].length, std::abs(arcs_[i].length), i);
      probe(&arcs_[i].kappa, kKappaWeight * limits_.max_kappa, count + i);
    }
    while (true) {
      const Eigen::MatrixXd weighted = weights.asDiagonal() * slopes.transpose();
      const Eigen::VectorXd change = -weighted * (slopes * weighted).ldlt().solve(error);
      if (!fixOutOfBounds(change, &weights)) return change;
    }
  }

  /// Sets the weights of what would be changed beyond its bounds to 0. @return  whether there was any.
  bool fixOutOfBounds(const Eigen::VectorXd& change, Eigen::VectorXd* weights) const {
    bool is_any = false;
    const auto count = static_cast<Eigen::Index>(arcs_.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      const ArcSegment& arc = arcs_[static_cast<std::size_t>(i)];
      const bool is_short = gearOf(arc) * (arc.length + change[i]) < leastLength(i);
      const bool is_tight = std::abs(arc.kappa + change[count + i]) > limits_.max_kappa;
      for (const auto& [is_out, column] : {std::pair(is_short, i), std::pair(is_tight, count + i)}) {
        if (!is_out || (*weights)[column] == 0.0) continue;
        (*weights)[column] = 0.0;
        is_any = true;
      }
    }
    return is_any;
  }

  /// With nothing between the ramps at both ends [m].
  double leastLength(Eigen::Index arc) const {
    const auto i = static_cast<std::size_t>(arc);
    return (i > 0 ? lengths_[i - 1] / 2.0 : 0.0) + lengths_[i] / 2.0;
  }

  void apply(const Eigen::VectorXd& change) {
    const auto count = static_cast<Eigen::Index>(arcs_.size());
    for (Eigen::Index i = 0; i < count; ++i) {
      ArcSegment& arc = arcs_[static_cast<std::size_t>(i)];
      const double gear = gearOf(arc);
      arc.length = gear * std::max(gear * (arc.length + change[i]), leastLength(i));
      arc.kappa = std::clamp(arc.kappa + change[count + i], -limits_.max_kappa, limits_.max_kappa);
    }
  }

  Pose2d from_, goal_;
  Limits limits_;
  Arcs arcs_;
  std::vector<double> lengths_;  ///< of the ramp after each arc [m]
};

/// The bent ramps as arcs; nullopt where they miss the goal or are not allowed.
std::optional<Arcs> allowed(Ramps* ramps, const CurveCheck& is_allowed) {
  if (ramps->bendBack() > kExactEnough) return std::nullopt;
  Arcs arcs = ramps->refined();
  if (!is_allowed(ramps->from(), arcs)) return std::nullopt;
  return arcs;
}

/// One tight place must not make all ramps short: each is made as long as it should be, where that is allowed.
Arcs grown(Ramps ramps, Arcs best, const CurveCheck& is_allowed) {
  for (std::size_t i = 0; i < ramps.size(); ++i) {
    if (ramps.wantedLength(i) <= ramps.length(i)) continue;
    Ramps longer = ramps;
    longer.setLength(i, ramps.wantedLength(i));
    if (auto result = allowed(&longer, is_allowed)) ramps = longer, best = *std::move(result);
  }
  return best;
}

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

/// Parts that end at gear changes or, where there is none for long, within an arc: what bends one back to its end does
/// not reach into the others, and the work grows with the way only.
std::vector<Arcs> partsOf(const Arcs& arcs) {
  std::vector<Arcs> parts(1);
  for (std::size_t i = 0; i < arcs.size(); ++i) {
    parts.back().push_back(arcs[i]);
    if (i + 1 == arcs.size() || parts.back().size() < kPartArcs) continue;
    if (gearOf(arcs[i]) != gearOf(arcs[i + 1])) {
      parts.emplace_back();
    } else if (parts.back().size() >= 2 * kPartArcs) {
      parts.back().back().length /= 2.0;
      parts.push_back({parts.back().back()});
    }
  }
  return parts;
}

struct Part {
  Pose2d begin, end;
  Arcs arcs;  ///< from about the one to about the other
};

/// @return  nullopt where the end cannot be met, or time is up.
std::optional<Arcs> withRamps(const Part& part, const Limits& limits, const CurveCheck& is_allowed,
                              const std::function<bool()>& stop) {
  double share = 1.0;
  for (int attempt = 1; attempt <= kAttempts && !stop(); ++attempt, share *= kShorter) {
    Ramps ramps(part.begin, part.end, limits, withoutShortArcs(part.arcs, share * kShortArc));
    ramps.setLengths(share);
    if (auto result = allowed(&ramps, is_allowed)) return share < 1.0 ? grown(ramps, *result, is_allowed) : *result;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Arcs> withSteeringRamps(const Pose2d& from, const Arcs& arcs, const ExactEnds& ends,
                                      const VehicleParams& vehicle, const RampShape& shape,
                                      const CurveCheck& is_allowed, const std::function<bool()>& stop) {
  const Limits limits{vehicle.maxKappa(), vehicle.maxKappa() / vehicle.rampLength(shape.speed), shape.step};
  Arcs result;
  Pose2d begin = from;
  const std::vector<Arcs> parts = partsOf(arcs);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Part part{begin, endOf(begin, parts[i]), parts[i]};
    begin = part.end;
    const bool is_first = i == 0 && ends.begin, is_last = i + 1 == parts.size() && ends.end;
    if (is_first) part.begin = *ends.begin;
    if (is_last) part.end = *ends.end;
    const std::optional<Arcs> ramped = withRamps(part, limits, is_allowed, stop);
    if (!ramped && (is_first || is_last)) return std::nullopt;
    const Arcs& driven = ramped ? *ramped : part.arcs;
    result.insert(result.end(), driven.begin(), driven.end());
  }
  return result;
}

}  // namespace external_command
