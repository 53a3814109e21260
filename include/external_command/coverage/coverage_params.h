// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>

namespace external_command {

/// What the order of the swaths is chosen for.
enum class CoverageObjective {
  kShortest,     ///< least distance driven
  kFewestTurns,  ///< the same, but laps and directions of swaths are chosen as if a turn were five times as long
};

/// How an area is swept.
struct CoverageParams {
  double swath_width = 2.0;  ///< of the tool, centred on the rear axle, [0.1, 100] [m]
  double overlap = 0.0;      ///< of neighbouring swaths, [0, swath_width / 2] [m]
  double margin = 0.03;      ///< the footprint keeps this distance to the border and the holes, [0, 5] [m]

  int headland_laps = -1;               ///< laps along border and holes, but for those so small that swaths bend round
                                        ///< them, [0, 50]; -1: as many as serve the objective
  bool headland_first = true;           ///< the laps along the outer border come before the swaths, not after them
  std::optional<double> swath_heading;  ///< of the straight swaths [rad]; not given: chosen for the objective
  CoverageObjective objective = CoverageObjective::kShortest;

  double target_coverage = 0.993;  ///< of the reachable area; beyond it, only what costs little is swept, [0.5, 1]
  double max_gap = 4.0;  ///< a connected piece that could be swept and is larger than so many squares of swath_width is
                         ///< swept too, where a way leads there, for at most 2 % more length; 0: none, [0, 1e6]
  double gear_change_cost = 4.0;  ///< price of a gear change: what the vehicle would drive in the time that it
                                  ///< takes to stop and to change, not negative [m]
  bool reverse_to_turn = true;    ///< false: what only reversing leads to is left out, but for laps that are wished
  double turn_speed = 2.0;  ///< at which turns can be steered where there is room, [0, 20] [m/s]; 0: they are arcs
                            ///< and straight pieces, between which the vehicle slows down and turns its wheels
  double spacing = 1.0;     ///< between points of the path, at most, [0.05, 100] [m]
  std::size_t max_grid_rows = 100000;  ///< of blocked cells side by side in the obstacle grid, [1, 10000000]
  double time_budget = 3.0;  ///< past 0.4 of it no further variant is tried, past all of it the plan is given up,
                             ///< (0, 3600] [s]

  /// @throws InvalidParameter  a value is out of range: the text names key, value and range.
  void validate() const;
};

}  // namespace external_command
