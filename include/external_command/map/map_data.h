// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "external_command/core/pose.h"

namespace external_command {

enum class LaneType { kNone, kCityDriving, kBiking, kSidewalk, kParking, kShoulder, kShared };
enum class TypeStatement { kKnown, kUnknown, kMissing };
enum class LaneTurn { kNoTurn, kLeft, kRight, kUTurn };
enum class LaneDirection { kForward, kBackward, kBidirection };
enum class BoundaryType { kUnknown, kDottedYellow, kDottedWhite, kSolidYellow, kSolidWhite, kDoubleYellow, kCurb };

/// The boundary is of `type` from `s` [m] on.
struct BoundaryTypeChange {
  double s = 0.0;
  BoundaryType type = BoundaryType::kUnknown;
};

struct LaneBoundary {
  std::vector<Point2d> points;
  std::vector<BoundaryTypeChange> types;  ///< by rising s; empty where the file says nothing
  bool is_virtual = false;                ///< not painted, inside a junction for example
};

/// From the lane's centre line at `s` to the boundary at that side [m].
struct WidthSample {
  double s = 0.0;
  double width = 0.0;
};

/// One map object's share in an overlap. `start_s`, `end_s` [m] are given for lanes only.
struct OverlapObject {
  std::string id;
  bool is_lane = false;
  double start_s = 0.0;
  double end_s = 0.0;
};

struct OverlapData {
  std::string id;
  std::vector<OverlapObject> objects;
};

/// A lane as a file states it; references are ids and may dangle.
struct LaneData {
  std::string id;
  std::vector<Point2d> center;
  std::vector<float> heights;  ///< of the points of `center` [m]; empty where the file gives none
  LaneBoundary left, right;
  std::vector<WidthSample> left_widths, right_widths;
  double length = 0.0;                     ///< as stated; the centre line's own length is what counts
  double speed_limit = 0.0;                ///< [m/s], 0 where not given
  LaneType type = LaneType::kCityDriving;  ///< kNone where the stated one is unknown
  TypeStatement type_statement = TypeStatement::kKnown;
  LaneTurn turn = LaneTurn::kNoTurn;
  LaneDirection direction = LaneDirection::kForward;
  std::vector<std::string> predecessors, successors;
  std::vector<std::string> left_forward, right_forward, left_reverse, right_reverse;
  std::vector<std::string> overlaps;
  std::string junction;  ///< empty: none
};

struct RoadSectionData {
  std::string id;
  std::vector<std::string> lanes;
};

struct RoadData {
  std::string id;
  std::vector<RoadSectionData> sections;
  std::string junction;  ///< empty: none
};

struct JunctionData {
  std::string id;
  std::vector<Point2d> polygon;
};

struct ParkingSpaceData {
  std::string id;
  std::vector<Point2d> polygon;
  double heading = 0.0;  ///< in which a vehicle parked nose in points [rad]
  bool has_heading = false;
  std::vector<std::string> overlaps;
};

struct AreaData {
  std::string id;
  std::string name;
  std::vector<Point2d> polygon;
  std::vector<std::string> overlaps;
};

/// A map as a file states it, before anything is resolved or checked. What every reader produces, and tests build.
struct MapData {
  std::uint64_t file_digest = 0;  ///< of all bytes of the file; 0 where it was made of something else
  std::string version;
  std::string projection;  ///< PROJ string, empty where not given
  std::vector<LaneData> lanes;
  std::vector<RoadData> roads;
  std::vector<JunctionData> junctions;
  std::vector<ParkingSpaceData> parking_spaces;
  std::vector<AreaData> areas;
  std::vector<OverlapData> overlaps;
};

}  // namespace external_command
