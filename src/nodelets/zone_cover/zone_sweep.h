// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "zone_tracker.h"

namespace external_command {

/// What a command to sweep a zone is about to do.
struct ZoneTask {
  CoverageProgress progress;    ///< with the lines, and what earlier runs have swept of them
  std::vector<Swath> swaths;    ///< on the command's path
  double covered_before = 0.0;  ///< by earlier runs [m^2]
  double goal_area = 0.0;       ///< to be covered in all [m^2]

  /// What the vehicle sweeps on the way to that path: the stretch of its present one that is put in front of it.
  std::vector<Swath> approach = {};  ///< with points of that stretch
  std::size_t approach_end = 0;      ///< its last point, at which the path begins
};

/// @param progress  of earlier runs, with the lines of `coverage`.
/// @param offset    of the coverage path's points in the path of the command.
ZoneTask taskOf(CoverageProgress progress, const CoverageResult& coverage, std::size_t offset);

/// The vehicle goes on along `approach`, and sweeps so much of it, before it comes to the path of `task`.
/// @param swaths  on it, which `task` counts as covered before.
void putInFront(std::vector<Swath> swaths, const Path& approach, ZoneTask* task);

/// Moves the swaths on the path by so many points, and puts those of the approach before them. What then lies before
/// its begin, since the vehicle was there before the command was sent, is not driven.
void shiftPoints(std::ptrdiff_t points, ZoneTask* task);

/// A zone that is being swept.
class ZoneSweep {
 public:
  /// @throws InternalError  the swaths are not on the path, or there are none.
  ZoneSweep(ZoneTask task, std::shared_ptr<const Path> path);

  /// The vehicle is here. @return  whether anything was swept since.
  bool follow(const Pose2d& vehicle);

  /// All of the path is swept. @return  as follow().
  bool finish();

  /// An earlier run went on while this one was planned. @return  as follow().
  bool takeOver(const CoverageProgress& earlier);

  const CoverageProgress& progress() const { return task_.progress; }

  /// What is swept on a stretch of the path, with points in that stretch; none where it is no stretch of the path.
  std::vector<Swath> swathsOn(const Path& stretch) const;

  /// "swath 7 of 30, 21 % covered", and which lap it is where it is one; numbers are those of the lines, from 1.
  std::string words() const;

 private:
  bool keep();

  ZoneTask task_;
  std::shared_ptr<const Path> path_;
  ZoneTracker tracker_;
};

}  // namespace external_command
