// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "external_command/core/path.h"
#include "external_command/coverage/coverage_planner.h"

namespace external_command {

/// Where along a coverage path the vehicle has come. Fed with its poses, at a few per second or more.
class ZoneTracker {
 public:
  /// @param path    the whole path of the command.
  /// @param swaths  of it, with point indices into `path`.
  ZoneTracker(Path path, std::vector<Swath> swaths);

  /// Follows the vehicle along the path; it never goes back. Poses further than 3 m from the path ahead count for
  /// nothing.
  void update(const Pose2d& vehicle);

  /// Position in `swaths` of the first that is not swept yet; their number where all are.
  std::size_t current() const { return current_; }

  /// Area swept so far [m^2].
  double coveredArea() const;

  const std::vector<Swath>& swaths() const { return swaths_; }

 private:
  const Path path_;
  const std::vector<Swath> swaths_;
  std::size_t reached_ = 0;  ///< point of the path
  std::size_t current_ = 0;
};

}  // namespace external_command
