// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "external_command/routing/router.h"

namespace external_command {

/// The route between two lane changes, begun with what lies abreast of the change that leads here: the rows of a route
/// overlap where it changes lanes. Positions along a row are metres from its beginning.
struct RouteRow {
  std::vector<LaneRange> pieces;
  double onto = 0.0;                      ///< up to here the change that leads here can be under way
  double leave = 0.0;                     ///< from here to the end the change that leads away can be
  double length = 0.0;                    ///< [m]
  LaneChange change = LaneChange::kNone;  ///< that leads away

  void add(const LaneRange& range);

  /// Where the piece ends that holds `position`.
  double pieceEndAt(double position) const;

  /// A piece of no length, there.
  LaneRange pointAt(double position) const;

  /// The pieces between two positions; a piece that is a single point belongs to what ends with it.
  std::vector<LaneRange> slice(double begin, double end) const;
};

/// One row more than the route has lane changes.
std::vector<RouteRow> rowsOf(const Route& route);

}  // namespace external_command
