// SPDX-License-Identifier: Apache-2.0
#include "turns.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace external_command {

namespace {

constexpr double kHardlyDearer = 0.5;  ///< than the cheapest is a short turn, in turning radii
/// How far before or beyond its ends a turn may begin and end, in turning radii: straight on, or backing up.
constexpr std::array<double, 11> kShifts = {0.0, 0.3, -0.3, 0.6, -0.6, 1.0, -1.0, 1.6, -1.6, 2.5, -2.5};
constexpr double kLongest = 4.0;      ///< how much dearer than the cheapest a turn may be, in turning radii
constexpr double kMostChanges = 4.0;  ///< and how many changes of gear on top of that
constexpr std::size_t kMostTried = 600;
constexpr std::array<double, 3> kSteps = {0.16, 0.08, 0.04};  ///< by which shifts are made better, in turning radii
constexpr double kGain = 0.05;                                ///< less is no better [m]
/// Of the shifts at both ends, in steps.
constexpr std::array<std::pair<int, int>, 8> kDirections = {
    {{-1, 0}, {0, -1}, {1, 0}, {0, 1}, {-1, -1}, {1, 1}, {1, -1}, {-1, 1}}};

Pose2d straightOn(const Pose2d& pose, double length) { return advance(pose, ArcSegment{length, 0.0}); }

class ShiftedTurns {
 public:
  ShiftedTurns(const Field& field, const Pose2d& from, const Pose2d& to) : field_(field), from_(from), to_(to) {}

  std::optional<Curve> find() const {
    for (const Turn& turn : onTheGrid()) {
      if (field_.isFree(turn.curve)) return improved(turn).curve;
    }
    return std::nullopt;
  }

 private:
  struct Turn {
    double cost = 0.0;
    double before = 0.0;  ///< driven straight on first [m]
    double after = 0.0;   ///< driven straight on last [m]
    Curve curve;
  };

  /// Cheapest first.
  std::vector<Turn> onTheGrid() const {
    const double most = turnsWithoutObstacles(from_, to_, field_.radius(), field_.gearPrice()).front().cost +
                        kLongest * field_.radius() + kMostChanges * field_.gearPrice();
    std::vector<Turn> turns;
    for (const double before : kShifts) {
      if (!field_.isFree(straightOn(from_, before * field_.radius()))) continue;
      for (const double after : kShifts) {
        for (Turn& turn : turnsWith(before * field_.radius(), after * field_.radius(), most)) {
          turns.push_back(std::move(turn));
        }
      }
    }
    std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.cost < b.cost; });
    if (turns.size() > kMostTried) turns.resize(kMostTried);
    return turns;
  }

  /// Those that cost `most` at most but for changes of gear where the turn meets the straight ends.
  std::vector<Turn> turnsWith(double before, double after, double most) const {
    const Pose2d begin = straightOn(from_, before), end = straightOn(to_, -after);
    const double shifted = std::abs(before) + std::abs(after);
    std::vector<Turn> turns;
    if (shifted + (end.position() - begin.position()).norm() > most || !field_.isFree(end)) return turns;
    for (SteeringCurve& steering : turnsWithoutObstacles(begin, end, field_.radius(), field_.gearPrice())) {
      if (steering.cost + shifted > most) break;
      Turn turn{0.0, before, after, {from_, {}}};
      turn.curve.append({before, 0.0});
      turn.curve.append(steering.arcs);
      turn.curve.append({after, 0.0});
      turn.cost = turn.curve.length() + field_.gearPrice() * turn.curve.gearChangesBetween();
      turns.push_back(std::move(turn));
    }
    return turns;
  }

  Turn improved(Turn best) const {
    for (const double step : kSteps) {
      while (takeStep(step * field_.radius(), &best)) {
      }
    }
    return best;
  }

  /// @return whether one makes it cheaper.
  bool takeStep(double step, Turn* best) const {
    const Turn old = *best;
    for (const auto& [before, after] : kDirections) {
      for (Turn& turn : turnsWith(old.before + step * before, old.after + step * after, best->cost - kGain)) {
        if (turn.cost > best->cost - kGain || !field_.isFree(turn.curve)) continue;
        *best = std::move(turn);
        break;
      }
    }
    return best->cost < old.cost;
  }

  const Field& field_;
  const Pose2d from_, to_;
};

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

std::optional<Curve> shortTurn(const Field& field, const Pose2d& from, const Pose2d& to) {
  const auto curves = turnsWithoutObstacles(from, to, field.radius(), field.gearPrice());
  const double most = curves.front().cost + kHardlyDearer * field.radius();
  for (const SteeringCurve& steering : curves) {
    if (steering.cost > most) break;
    Curve curve{from, {}};
    curve.append(steering.arcs);
    if (field.isFree(curve)) return curve;
  }
  return std::nullopt;
}

std::optional<Curve> shiftedTurn(const Field& field, const Pose2d& from, const Pose2d& to) {
  return ShiftedTurns(field, from, to).find();
}

}  // namespace external_command
