// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "coverage/field/field.h"
#include "coverage/work/work.h"
#include "links.h"

namespace external_command {

/// Work, and the order in which it is done.
struct Plan {
  std::vector<Work> works;
  std::vector<Step> steps;  ///< not every work need be done
  double price = 0.0;       ///< that a square metre may cost [m/m^2]
  double length = 0.0;      ///< with the ways between; about, until it is settled [m]
  double effort = 0.0;      ///< the length and the price of the changes of gear [m]
  double covered = 0.0;     ///< of the goal [m^2]
  /// Once settled: the ways that lead from the field's start to the first step, and from each to the next.
  std::vector<std::optional<Curve>> links;
};

/// Share of the goal below which coverage is bought at almost any price.
constexpr double kLowCoverage = 0.974;

/// What a plan is worth, less being better: its effort as multiple of a perfect path's, and prices for what it misses.
/// @param effort   length and price of the changes of gear [m].
/// @param length   driven [m].
/// @param covered  of the goal [m^2].
/// @param goal     [m^2].
double costOf(const Field& field, double effort, double length, double covered, double goal);

/// Orders `works`; then leaves out what costs more than it brings, and puts in swaths that bring more than they cost.
/// @param price  of a square metre that is not swept [m/m^2].
Plan planOf(const Field& field, std::vector<Work> works, double price, Guide* guide);

/// The plan with the ways between its steps worked out, and changed where those turn out longer than they looked
/// (lazy evaluation of edges, as in C. Dellin and S. Srinivasa 2016).
/// @param rounds  of changes, at most.
Plan settled(const Field& field, Plan plan, int rounds, Guide* guide);

/// The best of several plans, with more and fewer laps, and for higher and lower prices of what is not swept.
Plan bestPlan(const Field& field);

}  // namespace external_command
