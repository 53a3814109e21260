// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "coverage/field/field.h"
#include "curve.h"

namespace external_command {

/// Ways from pose to pose as if nothing were in the way, cheapest first, for a vehicle that arrives and leaves forward:
/// the Reeds-Shepp words, and those of Dubins, which hold loops that turn forward only. Never empty.
/// @param gear_price  of a change of gear, as length [m].
std::vector<SteeringCurve> turnsWithoutObstacles(const Pose2d& from, const Pose2d& to, double radius,
                                                 double gear_price);

/// One of these that the vehicle has room for, hardly dearer than the cheapest; nullopt: there is none.
std::optional<Curve> shortTurn(const Field& field, const Pose2d& from, const Pose2d& to);

/// One that begins and ends elsewhere along the lines through both ends, straight on or backed up, where there is room
/// for it: the cheapest of a grid of such shifts, and from there to where no small shift makes it cheaper (the pattern
/// search of Hooke and Jeeves 1961); nullopt: there is none.
std::optional<Curve> shiftedTurn(const Field& field, const Pose2d& from, const Pose2d& to);

}  // namespace external_command
