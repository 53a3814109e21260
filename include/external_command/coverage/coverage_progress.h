// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "external_command/core/cancel_token.h"
#include "external_command/core/polygon.h"
#include "external_command/core/vehicle.h"
#include "external_command/coverage/coverage_params.h"
#include "external_command/motion/reeds_shepp.h"

namespace external_command {

/// The line that the rear-axle centre drives on one piece of work: a lap along the border, a ring around a hole, or a
/// swath, which is straight but where it is bent round a small obstacle.
struct SwathLine {
  Pose2d start;
  std::vector<ArcSegment> arcs;
  int lap = -1;  ///< of a lap: 0 is the outermost, or the one next to a hole; -1: a swath

  bool isLap() const { return lap >= 0; }
  double length() const;  ///< driven [m]
};

/// The plan of an area and how far it has come. The default is a fresh start. Laps and swaths are the same here: both
/// are lines, each with its own progress, numbered in the order in which they are driven.
struct CoverageProgress {
  static constexpr std::size_t kMostLines = 100000;
  static constexpr std::size_t kMostArcs = 1000000;  ///< of all lines together
  static constexpr double kLineEnd = 0.2;            ///< what is left of a line that counts as swept, at most [m]

  std::vector<SwathLine> lines;      ///< CoverageResult::lines of the first run; none: they are planned
  std::vector<double> swept;         ///< of each line, from its start [m]; those beyond the end are not begun
  std::vector<std::size_t> skipped;  ///< of the lines: were blocked, tried again at the end

  double sweptOf(std::size_t line) const { return line < swept.size() ? swept[line] : 0.0; }
  bool isDone(std::size_t line) const;
  bool isSkipped(std::size_t line) const;
  std::size_t countDone() const;  ///< O(arcs)

  /// Line `line` is swept up to `length` [m] from its start, if it was not already. What is done is skipped no more.
  /// @return  whether that is news.
  bool sweep(std::size_t line, double length);

  /// Takes over what `other`, of the same lines, has swept.
  void merge(const CoverageProgress& other);
};

/// For what comes from a file: bounds and physics, so that a plan made of it takes neither minutes nor gigabytes.
/// @throws InvalidRequest  `progress` is no plan for this area and vehicle: a number is not finite, a line bends more
///                         than the vehicle can or leaves the area, more is swept than there is; the text names it.
/// @throws Cancelled
void requirePlausible(const CoverageProgress& progress, const Polygon& area, const VehicleParams& vehicle,
                      const CoverageParams& params, const CancelToken& cancel = {});

}  // namespace external_command
