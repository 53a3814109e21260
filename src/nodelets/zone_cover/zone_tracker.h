// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
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
  /// @throws InternalError  an index is beyond the path.
  ZoneTracker(std::shared_ptr<const Path> path, std::vector<Swath> swaths);

  /// Follows the vehicle along the path; it never goes back. Poses further than 3 m from the path ahead count for
  /// nothing, and so do those along it further than 15 m ahead, after poses that did.
  void update(const Pose2d& vehicle);

  /// The vehicle is at the end.
  void finish();

  /// Position in `swaths` of the first that is not swept yet; their number where all are.
  std::size_t current() const { return current_; }

  /// How far the line of a swath, by its position, is swept, from the start of the line [m]: up to the last point of
  /// the path that the vehicle has passed. 0 where the vehicle has not come to it.
  double sweptOf(std::size_t position) const;

  /// Area swept so far [m^2].
  double coveredArea() const;

  const std::vector<Swath>& swaths() const { return swaths_; }

 private:
  /// The point of the path that the vehicle is nearest to, in place and heading; nullopt where none is near.
  std::optional<std::size_t> nearest(const Pose2d& vehicle, double look_ahead, double farthest) const;

  const std::shared_ptr<const Path> path_;
  const std::vector<Swath> swaths_;
  std::size_t reached_ = 0;  ///< last point of the path that was passed
  std::size_t current_ = 0;
  bool is_on_path_ = true;  ///< at the last pose
};

}  // namespace external_command
