// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <map>
#include <optional>

#include "coverage/field/field.h"
#include "curve.h"

namespace external_command {

/// Finds turns and transfers: ways for the vehicle from pose to pose within the area. Remembers them: where there is no
/// way, that takes longest to find.
class Connector {
 public:
  explicit Connector(const Field& field) : field_(field) {}

  /// A short way from `from` to the start of `next`; nullopt if none was found. Where there is no turn, part of
  /// `driven` is backed along first, the way that led to `from`, or part of `next` last: out of a dead end, or into
  /// one.
  /// @param driven  nullptr: what led there is not known. `from` may then be nearer to something than the margin,
  ///                and is left with a smaller one nearby.
  std::optional<Curve> connect(const Curve* driven, const Pose2d& from, const Curve& next);

 private:
  std::optional<Curve> turn(const Pose2d& from, const Pose2d& to);
  std::optional<Curve> newTurn(const Pose2d& from, const Pose2d& to) const;
  std::optional<Curve> leave(const Pose2d& from, const Pose2d& to) const;
  std::optional<Curve> search(const Pose2d& from, const Pose2d& to) const;
  std::optional<Curve> searchNearAndFar(const Pose2d& from, const Pose2d& to) const;
  std::optional<Curve> searchWithin(const std::optional<BoundingBox>& box, const Pose2d& from, const Pose2d& to) const;

  const Field& field_;
  std::map<std::array<double, 6>, std::optional<Curve>> turns_;  ///< by the poses at their ends
};

}  // namespace external_command
