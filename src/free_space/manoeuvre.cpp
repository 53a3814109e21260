// SPDX-License-Identifier: Apache-2.0
#include "manoeuvre.h"

#include <array>
#include <cmath>

namespace external_command {

namespace {

constexpr double kLongArc = 1.0;  ///< whose middle is worth a look of its own [m]

}  // namespace

double costOf(const Arcs& arcs, const CostModel& cost, const Junctions& junctions) {
  double total = costBefore(arcs, cost, junctions) + costAfter(arcs, cost, junctions);
  for (const ArcSegment& arc : arcs) total += cost.ofArc(arc.length);
  for (std::size_t i = 1; i < arcs.size(); ++i) total += cost.between(arcs[i - 1], arcs[i]);
  return total;
}

double costBefore(const Arcs& arcs, const CostModel& cost, const Junctions& junctions) {
  if (arcs.empty() || junctions.before == 0) return 0.0;
  return cost.between({static_cast<double>(junctions.before), junctions.kappa_before}, arcs.front());
}

double costAfter(const Arcs& arcs, const CostModel& cost, const Junctions& junctions) {
  if (arcs.empty() || junctions.after == 0) return 0.0;
  return cost.between(arcs.back(), {static_cast<double>(junctions.after), junctions.kappa_after});
}

double lengthOf(const Arcs& arcs) {
  double length = 0.0;
  for (const ArcSegment& arc : arcs) length += std::abs(arc.length);
  return length;
}

unsigned gearChangesOf(const Arcs& arcs) {
  unsigned changes = 0;
  for (std::size_t i = 1; i < arcs.size(); ++i) changes += gearOf(arcs[i]) != gearOf(arcs[i - 1]);
  return changes;
}

double wheelTurnsOf(const Arcs& arcs, double radius) {
  CostModel turns;
  turns.steering_price = radius;
  double sum = 0.0;
  for (std::size_t i = 1; i < arcs.size(); ++i) sum += turns.between(arcs[i - 1], arcs[i]);
  return sum;
}

Arcs reversed(const Arcs& arcs) {
  Arcs back(arcs.rbegin(), arcs.rend());
  for (ArcSegment& arc : back) arc.length = -arc.length;
  return back;
}

Arcs merged(const Arcs& arcs) {
  Arcs result;
  for (const ArcSegment& arc : arcs) {
    if (std::abs(arc.length) < kEmptyArc) continue;
    const bool same =
        !result.empty() && gearOf(result.back()) == gearOf(arc) && std::abs(result.back().kappa - arc.kappa) < 1e-9;
    if (same) {
      result.back().length += arc.length;
    } else {
      result.push_back(arc);
    }
  }
  return result;
}

void append(const SteeringWord& word, Arcs* arcs) {
  arcs->insert(arcs->end(), word.arcs.begin(), word.arcs.begin() + word.size);
}

bool isFree(const FootprintIndex& index, const Pose2d& from, const SteeringWord& word, double step) {
  std::array<Pose2d, 6> begins;
  begins[0] = from;
  const auto size = static_cast<std::size_t>(word.size);
  for (std::size_t i = 0; i < size; ++i) {
    begins[i + 1] = advance(begins[i], word.arcs[i]);
    if (!index.isFree(begins[i + 1])) return false;
  }
  for (std::size_t i = 0; i < size; ++i) {
    const double length = std::abs(word.arcs[i].length);
    if (length > kLongArc && !index.isFree(advance(begins[i], word.arcs[i], 0.5 * length))) return false;
  }
  for (std::size_t i = 0; i < size; ++i) {
    if (index.freeLength(begins[i], word.arcs[i], step) < std::abs(word.arcs[i].length)) return false;
  }
  return true;
}

bool keepsMargin(const FootprintIndex& index, const Pose2d& from, const SteeringWord& word) {
  Pose2d begin = from;
  for (int i = 0; i < word.size; ++i) {
    const ArcSegment& arc = word.arcs[static_cast<std::size_t>(i)];
    if (!index.keepsMargin(begin, arc)) return false;
    begin = advance(begin, arc);
  }
  return true;
}

}  // namespace external_command
