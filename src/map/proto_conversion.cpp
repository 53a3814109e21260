// SPDX-License-Identifier: Apache-2.0
#include "proto_conversion.h"

#include <iterator>
#include <utility>

namespace external_command {

namespace {

template <class Points>
std::vector<Point2d> pointsOf(const Points& message) {
  std::vector<Point2d> points;
  points.reserve(static_cast<std::size_t>(message.point_size()));
  for (const proto::PointENU& point : message.point()) points.emplace_back(point.x(), point.y());
  return points;
}

std::vector<Point2d> pointsOf(const proto::Curve& curve) {
  if (curve.segment_size() == 1) return pointsOf(curve.segment(0).line_segment());
  std::vector<Point2d> points;
  for (const proto::CurveSegment& segment : curve.segment()) {
    const std::vector<Point2d> part = pointsOf(segment.line_segment());
    points.insert(points.end(), part.begin(), part.end());
  }
  return points;
}

std::vector<float> heightsOf(const proto::Curve& curve) {
  std::vector<float> heights;
  for (const proto::CurveSegment& segment : curve.segment()) {
    for (const proto::PointENU& point : segment.line_segment().point()) {
      heights.push_back(static_cast<float>(point.z()));
    }
  }
  return heights;
}

template <class Ids>
std::vector<std::string> textsOf(const Ids& ids) {
  std::vector<std::string> texts;
  texts.reserve(static_cast<std::size_t>(ids.size()));
  for (const proto::Id& id : ids) texts.push_back(id.id());
  return texts;
}

template <class Samples>
std::vector<WidthSample> widthsOf(const Samples& samples) {
  std::vector<WidthSample> widths;
  widths.reserve(static_cast<std::size_t>(samples.size()));
  for (const proto::LaneSampleAssociation& sample : samples) widths.push_back({sample.s(), sample.width()});
  return widths;
}

BoundaryType typeOf(const proto::LaneBoundaryType& change) {
  if (change.types_size() == 0) return BoundaryType::kUnknown;
  switch (change.types(0)) {
    case proto::LaneBoundaryType::DOTTED_YELLOW:
      return BoundaryType::kDottedYellow;
    case proto::LaneBoundaryType::DOTTED_WHITE:
      return BoundaryType::kDottedWhite;
    case proto::LaneBoundaryType::SOLID_YELLOW:
      return BoundaryType::kSolidYellow;
    case proto::LaneBoundaryType::SOLID_WHITE:
      return BoundaryType::kSolidWhite;
    case proto::LaneBoundaryType::DOUBLE_YELLOW:
      return BoundaryType::kDoubleYellow;
    case proto::LaneBoundaryType::CURB:
      return BoundaryType::kCurb;
    case proto::LaneBoundaryType::UNKNOWN:
      break;
  }
  return BoundaryType::kUnknown;
}

LaneType typeOf(proto::Lane::LaneType type) {
  switch (type) {
    case proto::Lane::CITY_DRIVING:
      return LaneType::kCityDriving;
    case proto::Lane::BIKING:
      return LaneType::kBiking;
    case proto::Lane::SIDEWALK:
      return LaneType::kSidewalk;
    case proto::Lane::PARKING:
      return LaneType::kParking;
    case proto::Lane::SHOULDER:
      return LaneType::kShoulder;
    case proto::Lane::SHARED:
      return LaneType::kShared;
    case proto::Lane::NONE:
      break;
  }
  return LaneType::kNone;
}

LaneTurn turnOf(const proto::Lane& lane) {
  switch (lane.turn()) {
    case proto::Lane::LEFT_TURN:
      return LaneTurn::kLeft;
    case proto::Lane::RIGHT_TURN:
      return LaneTurn::kRight;
    case proto::Lane::U_TURN:
      return LaneTurn::kUTurn;
    case proto::Lane::NO_TURN:
      break;
  }
  return LaneTurn::kNoTurn;
}

LaneDirection directionOf(const proto::Lane& lane) {
  switch (lane.direction()) {
    case proto::Lane::BACKWARD:
      return LaneDirection::kBackward;
    case proto::Lane::BIDIRECTION:
      return LaneDirection::kBidirection;
    case proto::Lane::FORWARD:
      break;
  }
  return LaneDirection::kForward;
}

LaneBoundary boundaryOf(const proto::LaneBoundary& message) {
  LaneBoundary boundary;
  boundary.points = pointsOf(message.curve());
  boundary.types.reserve(static_cast<std::size_t>(message.boundary_type_size()));
  for (const auto& change : message.boundary_type()) boundary.types.push_back({change.s(), typeOf(change)});
  boundary.is_virtual = message.virtual_();
  return boundary;
}

/// An enumerator that the description does not know ends up among the unknown fields.
bool hasUnknownType(const proto::Lane& lane) {
  const auto& unknown = lane.unknown_fields();
  for (int i = 0; i < unknown.field_count(); ++i) {
    if (unknown.field(i).number() == proto::Lane::kTypeFieldNumber) return true;
  }
  return false;
}

template <class T>
void append(std::vector<T>&& from, std::vector<T>* to) {
  to->insert(to->end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
}

}  // namespace

void ProtoConverter::add(const proto::Map& part) {
  if (part.has_header()) {
    data_.version = part.header().version();
    data_.projection = part.header().projection().proj();
  }
  for (const proto::Lane& lane : part.lane()) addLane(lane);
  for (const proto::Road& road : part.road()) addRoad(road);
  for (const proto::Overlap& overlap : part.overlap()) addOverlap(overlap);
  for (const proto::Junction& junction : part.junction()) {
    data_.junctions.push_back({junction.id().id(), pointsOf(junction.polygon())});
  }
  for (const proto::ParkingSpace& space : part.parking_space()) {
    data_.parking_spaces.push_back({space.id().id(), pointsOf(space.polygon()), space.heading(), space.has_heading(),
                                    textsOf(space.overlap_id())});
  }
  for (const proto::Area& area : part.ad_area()) {
    data_.areas.push_back({area.id().id(), area.name(), pointsOf(area.polygon()), textsOf(area.overlap_id())});
  }
}

MapData ProtoConverter::takeAll(std::vector<ProtoConverter> parts) {
  MapData all;
  std::size_t lanes = 0;
  for (const ProtoConverter& part : parts) lanes += part.data_.lanes.size();
  all.lanes.reserve(lanes);
  for (ProtoConverter& part : parts) {
    MapData from = std::move(part.data_);  // gone with its turn
    if (!from.version.empty()) all.version = std::move(from.version);
    if (!from.projection.empty()) all.projection = std::move(from.projection);
    append(std::move(from.lanes), &all.lanes);
    append(std::move(from.roads), &all.roads);
    append(std::move(from.overlaps), &all.overlaps);
    append(std::move(from.junctions), &all.junctions);
    append(std::move(from.parking_spaces), &all.parking_spaces);
    append(std::move(from.areas), &all.areas);
  }
  return all;
}

void ProtoConverter::addLane(const proto::Lane& message) {
  data_.lanes.emplace_back();
  LaneData& lane = data_.lanes.back();
  lane.id = message.id().id();
  lane.center = pointsOf(message.central_curve());
  lane.heights = heightsOf(message.central_curve());
  lane.left = boundaryOf(message.left_boundary());
  lane.right = boundaryOf(message.right_boundary());
  lane.left_widths = widthsOf(message.left_sample());
  lane.right_widths = widthsOf(message.right_sample());
  lane.length = message.length();
  lane.speed_limit = message.speed_limit();
  if (message.has_type()) {
    lane.type = typeOf(message.type());
  } else if (hasUnknownType(message)) {
    lane.type = LaneType::kNone;
    lane.type_statement = TypeStatement::kUnknown;
  } else {
    lane.type_statement = TypeStatement::kMissing;
  }
  lane.turn = turnOf(message);
  lane.direction = directionOf(message);
  lane.predecessors = textsOf(message.predecessor_id());
  lane.successors = textsOf(message.successor_id());
  lane.left_forward = textsOf(message.left_neighbor_forward_lane_id());
  lane.right_forward = textsOf(message.right_neighbor_forward_lane_id());
  lane.left_reverse = textsOf(message.left_neighbor_reverse_lane_id());
  lane.right_reverse = textsOf(message.right_neighbor_reverse_lane_id());
  lane.overlaps = textsOf(message.overlap_id());
  lane.junction = message.junction_id().id();
}

void ProtoConverter::addRoad(const proto::Road& message) {
  RoadData road{message.id().id(), {}, message.junction_id().id()};
  for (const proto::RoadSection& section : message.section()) {
    road.sections.push_back({section.id().id(), textsOf(section.lane_id())});
  }
  data_.roads.push_back(std::move(road));
}

void ProtoConverter::addOverlap(const proto::Overlap& message) {
  OverlapData overlap{message.id().id(), {}};
  for (const proto::ObjectOverlapInfo& object : message.object()) {
    const proto::LaneOverlapInfo& range = object.lane_overlap_info();
    overlap.objects.push_back({object.id().id(), object.has_lane_overlap_info(), range.start_s(), range.end_s()});
  }
  data_.overlaps.push_back(std::move(overlap));
}

}  // namespace external_command
