// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/map_markers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "external_command/ros/markers.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

using visualization_msgs::Marker;
using visualization_msgs::MarkerArray;

/// A road of 40 lanes of 50 m along x, each with a parking space beside it, and an area at its beginning.
std::shared_ptr<const HdMap> longRoad() {
  MapBuilder builder;
  for (int i = 0; i < 40; ++i) {
    const std::string number = std::to_string(i);
    builder.lane("lane_" + number, {50.0 * i, 0.0}, {50.0 * (i + 1), 0.0});
    builder.parkingSpace("space_" + number, {50.0 * i + 25.0, 6.0, 0.0}, 6.0, 2.5);
  }
  builder.area("yard", {{0.0, 20.0}, {40.0, 20.0}, {40.0, 60.0}, {0.0, 60.0}});
  return builder.build();
}

std::vector<Marker> inNamespace(const MarkerArray& array, const std::string& ns) {
  std::vector<Marker> found;
  for (const Marker& marker : array.markers) {
    if (marker.ns == ns) found.push_back(marker);
  }
  return found;
}

/// The texts of a namespace, each with a number of its own.
std::multiset<std::string> textsIn(const MarkerArray& array, const std::string& ns) {
  std::multiset<std::string> texts;
  std::set<int> numbers;
  for (const Marker& marker : inNamespace(array, ns)) {
    if (marker.type != Marker::TEXT_VIEW_FACING) continue;
    EXPECT_TRUE(numbers.insert(marker.id).second) << "two texts have number " << marker.id;
    EXPECT_GT(marker.scale.z, 0.0);
    texts.insert(marker.text);
  }
  return texts;
}

std::pair<double, double> rangeOfX(const Marker& marker) {
  std::pair<double, double> range = {1e9, -1e9};
  for (const auto& point : marker.points) {
    range.first = std::min(range.first, point.x);
    range.second = std::max(range.second, point.x);
  }
  return range;
}

TEST(MapPart, OfASmallMapIsAllOfItWhereverTheVehicleIs) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {40, 100.0});
  chooser.placeVehicle(Point2d(1e5, 0.0));
  EXPECT_EQ(chooser.part().lanes.size(), 40u);
  EXPECT_EQ(chooser.part().spaces.size(), 40u);
  chooser.placeVehicle(Point2d::Zero());
  EXPECT_FALSE(chooser.hasMoved());
}

TEST(MapPart, OfALargeMapIsWhatIsNearTheVehicle) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {20, 110.0});
  chooser.placeVehicle(Point2d(1025.0, 0.0));
  const MapPart part = chooser.part();
  ASSERT_EQ(part.lanes.size(), 5u);
  EXPECT_EQ(part.lanes.front()->id, "lane_20");
  EXPECT_EQ(part.spaces.size(), 5u);
  EXPECT_EQ(part.areas.size(), 1u) << "there are no more than 20 of them: all";
  EXPECT_LT(part.box.min.x(), 1025.0 - 100.0);
  EXPECT_GT(part.box.max.x(), 1025.0 + 100.0);
}

TEST(MapPart, HoldsNoMoreThanItMay) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {7, 1e5});
  chooser.placeVehicle(Point2d(1025.0, 0.0));
  const MapPart part = chooser.part();
  EXPECT_EQ(part.lanes.size(), 7u);
  EXPECT_EQ(part.spaces.size(), 7u);
  for (const ParkingSpace* space : part.spaces) {
    EXPECT_LT((space->polygon.points().front() - Point2d(1025.0, 0.0)).norm(), 200.0) << space->id;
  }
}

TEST(MapPart, IsThatOfTheMiddleUntilTheVehicleIsKnown) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {20, 60.0});
  chooser.placeVehicle(std::nullopt);
  ASSERT_FALSE(chooser.part().lanes.empty());
  EXPECT_NEAR(chooser.part().lanes.front()->center.pointAt(25.0).x(), 1000.0, 60.0);
}

TEST(MapPart, IsAnotherOneOnceTheVehicleHasComeFarther) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {20, 100.0});
  chooser.placeVehicle(Point2d(500.0, 0.0));
  chooser.part();
  chooser.placeVehicle(Point2d(520.0, 0.0));
  EXPECT_FALSE(chooser.hasMoved());
  chooser.placeVehicle(Point2d(530.0, 0.0));
  EXPECT_TRUE(chooser.hasMoved());
  chooser.part();
  EXPECT_FALSE(chooser.hasMoved());
  chooser.placeVehicle(std::nullopt);
  EXPECT_FALSE(chooser.hasMoved()) << "where it was last counts";
}

TEST(MapPart, IsAlsoWhatSomebodyLooksAt) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {8, 110.0});
  chooser.placeVehicle(Point2d(25.0, 0.0));
  chooser.part();
  chooser.lookAt(Point2d(1525.0, 0.0));
  EXPECT_TRUE(chooser.hasMoved());
  const MapPart part = chooser.part();
  std::set<std::string> ids;
  for (const Lane* lane : part.lanes) ids.insert(lane->id);
  EXPECT_EQ(ids, (std::set<std::string>{"lane_0", "lane_1", "lane_2", "lane_28", "lane_29", "lane_30", "lane_31",
                                        "lane_32"}));
}

TEST(MapMarkers, DrawTheChosenPartAndDeleteWhatItHasNot) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {20, 110.0});
  chooser.placeVehicle(Point2d(1025.0, 0.0));
  const MarkerArray array = mapMarkers(chooser.part(), "map");
  const auto surfaces = inNamespace(array, "lanes");
  ASSERT_EQ(surfaces.size(), 1u);
  EXPECT_EQ(surfaces[0].action, Marker::ADD);
  EXPECT_EQ(surfaces[0].header.frame_id, "map");
  EXPECT_GE(rangeOfX(surfaces[0]).first, 900.0);
  EXPECT_LE(rangeOfX(surfaces[0]).second, 1150.0);
  const auto junctions = inNamespace(array, "junctions");
  ASSERT_EQ(junctions.size(), 1u);
  EXPECT_EQ(junctions[0].action, Marker::DELETE);
}

TEST(IdMarkers, NameEachLaneSpaceAndArea) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {100, 100.0});
  const MarkerArray array = idMarkers(chooser.part(), "map");
  EXPECT_EQ(textsIn(array, "lane_ids").size(), 40u);
  EXPECT_EQ(textsIn(array, "parking_space_ids").count("space_17"), 1u);
  EXPECT_EQ(textsIn(array, "area_ids"), std::multiset<std::string>{"yard"});
}

TEST(IdMarkers, NameALaneOfBothDirectionsOnce) {
  MapBuilder builder;
  builder.lane("both", {0.0, 0.0}, {100.0, 0.0});
  builder["both"].direction = LaneDirection::kBidirection;
  const auto map = builder.build();
  ASSERT_EQ(map->lanes().size(), 2u);
  MapPartChooser chooser(*map, {});
  EXPECT_EQ(textsIn(idMarkers(chooser.part(), "map"), "lane_ids"), std::multiset<std::string>{"both"});
}

TEST(LegendMarkers, LieBelowThePartAndHaveAScale) {
  const auto map = longRoad();
  MapPartChooser chooser(*map, {});
  const MapPart part = chooser.part();
  const MarkerArray array = legendMarkers(part, "map");
  const auto texts = textsIn(array, "legend");
  EXPECT_EQ(texts.count("parking space"), 1u);
  EXPECT_EQ(texts.count("200 m"), 1u) << "the largest round length that takes no more than a fifth of 2 km";
  for (const Marker& marker : array.markers) {
    if (marker.type == Marker::TEXT_VIEW_FACING) {
      EXPECT_LT(marker.pose.position.y, part.box.min.y());
      continue;
    }
    EXPECT_EQ(marker.colors.size(), marker.points.size());
    for (const auto& point : marker.points) EXPECT_LT(point.y, part.box.min.y());
  }
}

TEST(VehicleMarkers, AreAFootprintAndARingThatMoveWithTheVehicle) {
  VehicleParams vehicle;
  vehicle.wheelbase = 2.8;
  vehicle.front_overhang = vehicle.rear_overhang = 1.0;
  vehicle.width = 2.0;
  const MarkerArray array = vehicleMarkers(vehicle, "base_link", 20.0);
  for (const char* ns : {"footprint", "vehicle_ring"}) {
    ASSERT_EQ(inNamespace(array, ns).size(), 1u) << ns;
    EXPECT_TRUE(inNamespace(array, ns)[0].frame_locked) << ns;
    EXPECT_EQ(inNamespace(array, ns)[0].header.frame_id, "base_link") << ns;
  }
  const Marker ring = inNamespace(array, "vehicle_ring")[0];
  EXPECT_EQ(ring.points.size() % 3, 0u);
  EXPECT_NEAR(rangeOfX(ring).first, -20.0, 1e-6);
  EXPECT_GT(rangeOfX(ring).second, 25.0) << "it points ahead";
}

}  // namespace
}  // namespace external_command
