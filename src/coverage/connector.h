// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "curve.h"
#include "field.h"

namespace external_command {

/// Finds turns and transfers: ways for the vehicle from pose to pose within the area.
class Connector {
 public:
  explicit Connector(const Field& field) : field_(field) {}

  /// A short way from `from` to `to`; nullopt if none was found.
  std::optional<Curve> connect(const Pose2d& from, const Pose2d& to) const;

 private:
  std::optional<Curve> shortTurn(const Pose2d& from, const Pose2d& to) const;
  std::optional<Curve> shiftedTurn(const Pose2d& from, const Pose2d& to) const;
  std::optional<Curve> search(const Pose2d& from, const Pose2d& to) const;

  const Field& field_;
};

}  // namespace external_command
