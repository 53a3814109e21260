// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "external_command/core/path.h"

namespace external_command {

/// Where along a path the vehicle has come. Fed with its poses, at a few per second or more. It never goes back, so a
/// path that crosses or repeats itself, or ends where it began, is followed in its order.
class PathProgress {
 public:
  /// @param path  not empty.
  explicit PathProgress(std::shared_ptr<const Path> path);

  /// Poses further than 3 m from the next 15 m of the path count for nothing; the stretch grows while no pose counts.
  /// @param now  of any steady clock [s].
  void update(const Pose2d& vehicle, double now);

  /// Index of the point that was reached.
  std::size_t reached() const { return reached_; }

  double along() const { return along_; }                               ///< `s` of the vehicle, between points too [m]
  double drivenLength() const { return along_ - path_->front().s; }     ///< [m]
  double lengthLeft() const { return path_->back().s - along_; }        ///< [m]
  double length() const { return path_->back().s - path_->front().s; }  ///< [m]

  /// Of the path, that is driven, in [0, 1].
  double shareDone() const { return length() > 0.0 ? drivenLength() / length() : 1.0; }

  const Path& path() const { return *path_; }

 private:
  double alongBeside(const Pose2d& vehicle) const;

  std::shared_ptr<const Path> path_;
  std::size_t reached_ = 0;
  double along_;                   ///< [m]
  std::optional<double> counted_;  ///< when a pose counted last [s]
};

}  // namespace external_command
