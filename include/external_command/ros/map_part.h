// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "external_command/map/hd_map.h"

namespace external_command {

/// How much of a map is drawn.
struct MapPartParams {
  std::size_t max_objects = 5000;  ///< a kind (lanes, junctions, ...) of no more is drawn whole; else the nearest ones
  double radius = 300.0;           ///< of those, what is this near to where somebody looks [m]
};

/// What of a map is drawn. It points into the map, which must live as long.
struct MapPart {
  BoundingBox box;  ///< of what is to be seen, about
  std::vector<const Lane*> lanes;
  std::vector<const Junction*> junctions;
  std::vector<const ParkingSpace*> spaces;
  std::vector<const Area*> areas;
};

/// Chooses what of a map is drawn: all of a small one, once; else what is near the vehicle, and near another place that
/// somebody looks at. Not thread-safe.
class MapPartChooser {
 public:
  /// @param map  must live as long as this.
  MapPartChooser(const HdMap& map, const MapPartParams& params);

  /// Where the vehicle is; nullopt: not known. Until it is known, the middle of the map takes its place.
  void placeVehicle(const std::optional<Point2d>& place);

  /// A place that is looked at besides.
  void lookAt(const Point2d& place);

  /// Has a place come so far from where it was at the last part() that another part is to be drawn?
  bool hasMoved() const;

  MapPart part();

 private:
  std::vector<Point2d> places() const;

  const HdMap& map_;
  const MapPartParams params_;
  const bool is_whole_;  ///< every kind is
  Point2d vehicle_;
  std::optional<Point2d> looked_at_;
  std::vector<Point2d> drawn_;  ///< places() of the last part()
};

}  // namespace external_command
