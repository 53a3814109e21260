// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace external_command {

/// How a free-space path is searched for, and what makes it good: the cheapest path is the one with the smallest
/// `forward length + reverse_factor * reverse length + gear_change_cost * gear changes + steering_cost * turns of the
/// wheels between them + closeness_cost * length near obstacles`. The search for a first path knows nothing of the last
/// two; the improvement does.
struct FreeSpaceParams {
  std::string planner = "portfolio";    ///< one of freeSpacePlanners()
  double margin = 0.10;                 ///< distance the footprint keeps to every obstacle and border, but where
                                        ///< the start or the goal is nearer, [0, 5] [m]
  double time_budget = 1.0;             ///< the answer comes within this time, improvement included, (0, 3600] [s]
  double improve_budget = 0.2;          ///< of it, spent at most on improving the first path, not negative [s]
  unsigned max_iterations = 1000000;    ///< of the own search for the first path, but for the legs of a long way, which
                                        ///< are bounded by themselves; bounds the memory too, [1, 10000000]
  unsigned improve_iterations = 10000;  ///< of the improvement; 0: until improve_budget is spent
  unsigned seed = 1;                    ///< same request, same seed, budgets not reached by the clock: same path,
                                        ///< but for OMPL's planners, which take the first seed of a process
  unsigned threads = 1;                 ///< that improve the path side by side, [1, 64]

  double gear_change_cost = 3.0;  ///< price of a gear change, as length, not negative [m]
  double reverse_factor = 2.0;    ///< price of a metre in reverse, as length forward, [1, 100]
  double steering_cost = 0.15;  ///< price of turning the wheels from straight on to full lock between gear changes, as
                                ///< length, in [0, 100] [m]
  double closeness_cost = 0.2;  ///< price of a metre beside an obstacle at the margin, as length on top of it; less
                                ///< farther away, in [0, 100]
  double closeness_distance = 0.5;  ///< beyond the margin; from there on it costs nothing, [0.01, 2] [m]
  double spacing = 0.05;            ///< between points of the result, at most, [0.01, 1] [m]

  /// Between gear changes the curvature changes gradually, and the points' speed limits let the steering keep up. Where
  /// there is no room for ramps as long as manoeuvre_speed asks for, they are shorter and the limits lower. False: the
  /// curvature jumps from arc to arc, and speeds do not mind it.
  bool continuous_curvature = true;
  double manoeuvre_speed = 0.5;  ///< at which the steering keeps up where there is room, (0, 5] [m/s]

  /// @throws InvalidParameter  a value is out of range: the text names key, value and range.
  void validate() const;
};

/// Names that FreeSpaceParams::planner takes: "portfolio" (the default: own search, shortening, improvement),
/// "hybrid_astar" (the search alone), and OMPL's "rrtconnect", "rrtstar", "kpiece" on Reeds-Shepp curves.
const std::vector<std::string>& freeSpacePlanners();

}  // namespace external_command
