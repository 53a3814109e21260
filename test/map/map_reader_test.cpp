// SPDX-License-Identifier: Apache-2.0
#include "external_command/map/map_reader.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include <thread>

#include "external_command/core/error.h"
#include "external_command/proto/base_map.pb.h"
#include "map/map_files.h"

namespace external_command {
namespace {

/// One object of each kind, every field set, no two alike.
constexpr const char* kEverything = R"(
header { version: "1.5" projection { proj: "+proj=utm +zone=10" } }
junction { id { id: "j" } polygon { point { x: 1 y: 2 z: 9 } point { x: 3 y: 4 } } }
lane {
  id { id: "a" }
  central_curve {
    segment { line_segment { point { x: 10 y: 11 z: 5 } point { x: 12 y: 13 } } }
    segment { line_segment { point { x: 14 y: 15 } } }
  }
  left_boundary {
    curve { segment { line_segment { point { x: 20 y: 21 } point { x: 22 y: 23 } } } }
    virtual: true
    boundary_type { s: 0 types: SOLID_YELLOW types: CURB }
    boundary_type { s: 4 types: DOTTED_WHITE }
  }
  right_boundary {
    curve { segment { line_segment { point { x: 30 y: 31 } } } }
    boundary_type { s: 7 types: CURB }
  }
  length: 5.5
  speed_limit: 8.25
  overlap_id { id: "o1" } overlap_id { id: "o2" }
  predecessor_id { id: "p1" } predecessor_id { id: "p2" }
  successor_id { id: "s1" }
  left_neighbor_forward_lane_id { id: "lf" }
  right_neighbor_forward_lane_id { id: "rf" }
  type: BIKING
  turn: U_TURN
  left_neighbor_reverse_lane_id { id: "lr" }
  right_neighbor_reverse_lane_id { id: "rr" }
  junction_id { id: "j" }
  left_sample { s: 0 width: 1.5 } left_sample { s: 3 width: 1.75 }
  right_sample { s: 1 width: 2 }
  direction: BIDIRECTION
}
overlap {
  id { id: "o1" }
  object { id { id: "a" } lane_overlap_info { start_s: 1.5 end_s: 2.5 } }
  object { id { id: "space" } }
}
road { id { id: "r" } section { id { id: "1" } lane_id { id: "a" } lane_id { id: "b" } } junction_id { id: "j" } }
parking_space { id { id: "space" } polygon { point { x: 5 y: 6 } } overlap_id { id: "o1" } heading: 1.25 }
ad_area { id { id: "area" } polygon { point { x: 7 y: 8 } } overlap_id { id: "o2" } name: "yard" }
)";

proto::Map everything() {
  proto::Map map;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(kEverything, &map));
  return map;
}

TEST(MapReader, ReadsEveryFieldOfALane) {
  const MapData data = dataOf(everything().SerializeAsString());
  ASSERT_EQ(data.lanes.size(), 1u);
  const LaneData& lane = data.lanes[0];
  using Points = std::vector<Point2d>;
  using Ids = std::vector<std::string>;
  EXPECT_EQ(lane.id, "a");
  EXPECT_EQ(lane.center, (Points{{10, 11}, {12, 13}, {14, 15}}));
  EXPECT_EQ(lane.left.points, (Points{{20, 21}, {22, 23}}));
  EXPECT_EQ(lane.right.points, (Points{{30, 31}}));
  EXPECT_TRUE(lane.left.is_virtual);
  EXPECT_FALSE(lane.right.is_virtual);
  ASSERT_EQ(lane.left.types.size(), 2u);
  EXPECT_EQ(lane.left.types[0].type, BoundaryType::kSolidYellow);
  EXPECT_EQ(lane.left.types[1].s, 4.0);
  EXPECT_EQ(lane.left.types[1].type, BoundaryType::kDottedWhite);
  EXPECT_EQ(lane.right.types[0].type, BoundaryType::kCurb);
  EXPECT_EQ(lane.length, 5.5);
  EXPECT_EQ(lane.speed_limit, 8.25);
  EXPECT_EQ(lane.type, LaneType::kBiking);
  EXPECT_EQ(lane.turn, LaneTurn::kUTurn);
  EXPECT_EQ(lane.direction, LaneDirection::kBidirection);
  EXPECT_EQ(lane.overlaps, (Ids{"o1", "o2"}));
  EXPECT_EQ(lane.predecessors, (Ids{"p1", "p2"}));
  EXPECT_EQ(lane.successors, Ids{"s1"});
  EXPECT_EQ(lane.left_forward, Ids{"lf"});
  EXPECT_EQ(lane.right_forward, Ids{"rf"});
  EXPECT_EQ(lane.left_reverse, Ids{"lr"});
  EXPECT_EQ(lane.right_reverse, Ids{"rr"});
  EXPECT_EQ(lane.junction, "j");
  ASSERT_EQ(lane.left_widths.size(), 2u);
  EXPECT_EQ(lane.left_widths[1].s, 3.0);
  EXPECT_EQ(lane.left_widths[1].width, 1.75);
  EXPECT_EQ(lane.right_widths[0].width, 2.0);
}

TEST(MapReader, ReadsEveryFieldOfTheOtherObjects) {
  const MapData data = dataOf(everything().SerializeAsString());
  EXPECT_EQ(data.version, "1.5");
  EXPECT_EQ(data.projection, "+proj=utm +zone=10");
  EXPECT_EQ(data.junctions.at(0).id, "j");
  EXPECT_EQ(data.junctions[0].polygon.at(1), Point2d(3, 4));
  EXPECT_EQ(data.roads.at(0).id, "r");
  EXPECT_EQ(data.roads[0].junction, "j");
  EXPECT_EQ(data.roads[0].sections.at(0).id, "1");
  EXPECT_EQ(data.roads[0].sections[0].lanes, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(data.parking_spaces.at(0).id, "space");
  EXPECT_EQ(data.parking_spaces[0].polygon.at(0), Point2d(5, 6));
  EXPECT_EQ(data.parking_spaces[0].overlaps.at(0), "o1");
  EXPECT_TRUE(data.parking_spaces[0].has_heading);
  EXPECT_EQ(data.parking_spaces[0].heading, 1.25);
  EXPECT_EQ(data.areas.at(0).id, "area");
  EXPECT_EQ(data.areas[0].name, "yard");
  EXPECT_EQ(data.areas[0].polygon.at(0), Point2d(7, 8));
  EXPECT_EQ(data.areas[0].overlaps.at(0), "o2");
  const OverlapData& overlap = data.overlaps.at(0);
  EXPECT_EQ(overlap.id, "o1");
  EXPECT_EQ(overlap.objects.at(0).id, "a");
  EXPECT_TRUE(overlap.objects[0].is_lane);
  EXPECT_EQ(overlap.objects[0].start_s, 1.5);
  EXPECT_EQ(overlap.objects[0].end_s, 2.5);
  EXPECT_EQ(overlap.objects.at(1).id, "space");
  EXPECT_FALSE(overlap.objects[1].is_lane);
}

TEST(MapReader, ReadsTheSameFromTextAndBinary) {
  EXPECT_TRUE(sameData(dataOf(everything().SerializeAsString()), dataOf(kEverything)));
}

TEST(MapReader, ReadsWhatProtobufPrints) {
  std::string printed;
  google::protobuf::TextFormat::PrintToString(everything(), &printed);
  EXPECT_TRUE(sameData(dataOf(kEverything), dataOf(printed)));
}

TEST(MapReader, KnowsEveryEnumerator) {
  proto::Map map = everything();
  const LaneType types[] = {LaneType::kNone,    LaneType::kCityDriving, LaneType::kBiking, LaneType::kSidewalk,
                            LaneType::kParking, LaneType::kShoulder,    LaneType::kShared};
  for (int i = 0; i < 7; ++i) {
    map.mutable_lane(0)->set_type(static_cast<proto::Lane::LaneType>(i + 1));
    EXPECT_EQ(dataOf(map.SerializeAsString()).lanes[0].type, types[i]);
  }
  const LaneTurn turns[] = {LaneTurn::kNoTurn, LaneTurn::kLeft, LaneTurn::kRight, LaneTurn::kUTurn};
  for (int i = 0; i < 4; ++i) {
    map.mutable_lane(0)->set_turn(static_cast<proto::Lane::LaneTurn>(i + 1));
    EXPECT_EQ(dataOf(map.SerializeAsString()).lanes[0].turn, turns[i]);
  }
  const LaneDirection directions[] = {LaneDirection::kForward, LaneDirection::kBackward, LaneDirection::kBidirection};
  for (int i = 0; i < 3; ++i) {
    map.mutable_lane(0)->set_direction(static_cast<proto::Lane::LaneDirection>(i + 1));
    EXPECT_EQ(dataOf(map.SerializeAsString()).lanes[0].direction, directions[i]);
  }
  for (int i = 0; i < 7; ++i) {
    auto* boundary = map.mutable_lane(0)->mutable_right_boundary()->mutable_boundary_type(0);
    boundary->set_types(0, static_cast<proto::LaneBoundaryType::Type>(i));
    EXPECT_EQ(static_cast<int>(dataOf(map.SerializeAsString()).lanes[0].right.types[0].type), i);
  }
}

TEST(MapReader, TakesAnUnsetTypeForADrivingLaneAndSaysSo) {
  proto::Map map = everything();
  map.mutable_lane(0)->clear_type();
  const MapData data = dataOf(map.SerializeAsString());
  EXPECT_EQ(data.lanes[0].type, LaneType::kCityDriving);
  EXPECT_TRUE(warnsOf(HdMap(data, Point2d::Zero()).warnings(), 1, "lanes without a type"));
}

TEST(MapReader, DoesNotDriveOnALaneOfAnUnknownType) {
  proto::Map map = everything();
  map.mutable_lane(0)->clear_type();
  map.mutable_lane(0)->mutable_unknown_fields()->AddVarint(proto::Lane::kTypeFieldNumber, 77);
  const MapData data = dataOf(map.SerializeAsString());
  EXPECT_EQ(data.lanes[0].type, LaneType::kNone);
  EXPECT_TRUE(warnsOf(HdMap(data, Point2d::Zero()).warnings(), 1, "lanes of a type that is not known"));
}

TEST(MapReader, PassesOverObjectsAndFieldsItDoesNotKnow) {
  proto::Map map = everything();
  const auto addUnknown = [](google::protobuf::Message* message) {
    auto* unknown = message->GetReflection()->MutableUnknownFields(message);
    unknown->AddVarint(1000, 5);
    unknown->AddFixed32(1001, 5);
    unknown->AddFixed64(1002, 5);
    unknown->AddLengthDelimited(1003)->assign("something");
  };
  addUnknown(&map);
  addUnknown(map.mutable_lane(0));
  addUnknown(map.mutable_lane(0)->mutable_central_curve());
  EXPECT_TRUE(sameData(dataOf(map.SerializeAsString()), dataOf(kEverything)));
}

TEST(MapReader, SubtractsTheOriginThatIsAskedFor) {
  const TemporaryFile file(everything().SerializeAsString());
  EXPECT_EQ(readMap(file.path(), {})->origin(), Point2d(0, 0));
  const auto centred = readMap(file.path(), {MapOrigin::Kind::kAuto, {}});
  EXPECT_EQ(centred->origin(), Point2d(12, 13));
  EXPECT_EQ(centred->lanes()[0].center.points()[0], Point2d(-2, -2));
  const auto given = readMap(file.path(), {MapOrigin::Kind::kGiven, {1.5, 2.5}});
  EXPECT_EQ(given->origin(), Point2d(1.5, 2.5));
  EXPECT_EQ(given->lanes()[0].center.points()[0], Point2d(8.5, 8.5));
}

TEST(MapReader, CentresOnTheUsableLanes) {
  proto::Map map = everything();
  *map.add_lane() = map.lane(0);
  map.mutable_lane(1)->mutable_id()->set_id("wild");
  auto* point =
      map.mutable_lane(1)->mutable_central_curve()->mutable_segment(0)->mutable_line_segment()->mutable_point(0);
  point->set_x(1e300);
  const TemporaryFile file(map.SerializeAsString());
  EXPECT_EQ(readMap(file.path(), {MapOrigin::Kind::kAuto, {}})->origin(), Point2d(12, 13));
}

TEST(MapReader, NamesTheFileWhereNoLaneCanBeUsed) {
  proto::Map map = everything();
  map.mutable_lane(0)->clear_central_curve();
  const TemporaryFile file(map.SerializeAsString());
  try {
    readMap(file.path(), {});
    FAIL();
  } catch (const MapError& error) {
    EXPECT_EQ(std::string(error.what()).find(file.path() + ": none of the map's 1 lanes"), 0u) << error.what();
  }
}

/// A field of a map: a lane of some kilobytes, and an area of the same id.
std::string laneAndArea(int id) {
  proto::Map part;
  proto::Lane* lane = part.add_lane();
  lane->mutable_id()->set_id(std::to_string(id));
  auto* line = lane->mutable_central_curve()->add_segment()->mutable_line_segment();
  for (int i = 0; i < 200; ++i) line->add_point()->set_x(i);
  part.add_ad_area()->mutable_id()->set_id(std::to_string(id));
  return part.SerializeAsString();
}

constexpr int kManyLanes = 3000;

TEST(MapReader, ReadsALargeFileInPartsWithAllInItsOrder) {
  std::string bytes;
  for (int id = 0; id < kManyLanes; ++id) bytes += laneAndArea(id);
  proto::Map last;
  last.mutable_header()->set_version("7");
  const TemporaryFile file(bytes + last.SerializeAsString());
  const MapData data = readMapData(file.path());
  EXPECT_EQ(data.version, "7");
  ASSERT_EQ(data.lanes.size(), static_cast<std::size_t>(kManyLanes));
  ASSERT_EQ(data.areas.size(), data.lanes.size());
  for (std::size_t i = 0; i < data.lanes.size(); ++i) {
    EXPECT_EQ(data.lanes[i].id, std::to_string(i));
    EXPECT_EQ(data.areas[i].id, std::to_string(i));
    EXPECT_EQ(data.lanes[i].center.size(), 200U);
  }
}

TEST(MapReader, NamesTheFirstOfSeveralDamagedPlacesOfALargeFile) {
  std::string bytes;
  std::vector<std::size_t> begins;
  for (int id = 0; id < kManyLanes; ++id) {
    begins.push_back(bytes.size());
    bytes += laneAndArea(id);
  }
  const auto damage = [&](int lane) { bytes[begins[static_cast<std::size_t>(lane)] + 4] = '\x0f'; };
  const auto sense = [&](int lane) {
    return "no sense from byte " + std::to_string(begins[static_cast<std::size_t>(lane)]) + " of";
  };
  for (const int lane : {kManyLanes - 2, kManyLanes / 2, 1}) {  // each is the first then
    damage(lane);
    const std::string why = refusal(bytes);
    EXPECT_NE(why.find(sense(lane)), std::string::npos) << why;
  }
  bytes.resize(bytes.size() - 3);  // the end of the last field is missing, too
  EXPECT_NE(refusal(bytes).find(sense(1)), std::string::npos) << refusal(bytes);
}

TEST(MapReader, MayReadInSeveralThreads) {
  const TemporaryFile file(everything().SerializeAsString());
  std::vector<std::thread> threads;
  for (int i = 0; i < 4; ++i) {
    threads.emplace_back([&file] {
      for (int k = 0; k < 50; ++k) EXPECT_EQ(readMap(file.path(), {})->lanes().size(), 1u);
    });
  }
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
}  // namespace external_command
