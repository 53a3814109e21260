// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "external_command/routing/router.h"

namespace external_command {

/// Shortens lanes that follow each other where the next one does not begin where the last one ends: overlapping ends
/// are cut, and where they lie beside each other there is room for a slanting way from one to the other. The first
/// beginning and the last end stay.
void joinEnds(const HdMap& map, std::vector<LaneRange>* pieces);

/// Which points of a line, in order, are left of it when it no longer turns back on itself: a fold, where it goes back
/// by at most 10 m and then on in its old direction, is left out, and so are points that repeat the one before. A line
/// that turns round for good does so still. The first point and the last are kept.
std::vector<std::size_t> withoutFolds(const std::vector<Point2d>& points);

}  // namespace external_command
