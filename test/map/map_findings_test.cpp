// SPDX-License-Identifier: Apache-2.0
// What is wrong with a map, as counted warnings for a log and as findings for a program: the same, told twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "external_command/map/map_reader.h"
#include "map/map_files.h"
#include "support/map_builder.h"

namespace external_command {
namespace {

std::vector<MapFinding> findingsOf(const MapData& data) {
  MapParams params;
  params.keep_findings = true;
  return HdMap(data, Point2d::Zero(), params).findings();
}

/// Whether each warning counts the findings of one kind, and has one of them as its example.
testing::AssertionResult agree(const MapData& data) {
  MapParams params;
  params.keep_findings = true;
  const HdMap map(data, Point2d::Zero(), params);
  std::size_t counted = 0;
  for (const MapWarning& warning : map.warnings()) {
    const auto is_counted = [&](const MapFinding& finding) {
      return warning.what.find(std::string(" ") + kindOf(finding.fault).what + ", ") != std::string::npos;
    };
    const auto is_example = [&](const MapFinding& finding) {
      const std::string& what = finding.what;
      return is_counted(finding) && warning.what.size() > what.size() &&
             warning.what.compare(warning.what.size() - what.size(), what.size(), what) == 0;
    };
    const std::vector<MapFinding>& all = map.findings();
    const auto count = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), is_counted));
    if (count != warning.count) return testing::AssertionFailure() << warning.what << ": " << count << " findings";
    if (std::none_of(all.begin(), all.end(), is_example)) {
      return testing::AssertionFailure() << "no finding is the example of: " << warning.what;
    }
    counted += count;
  }
  if (counted != map.findings().size()) {
    return testing::AssertionFailure() << map.findings().size() - counted << " findings that no warning counts";
  }
  return testing::AssertionSuccess() << counted << " findings";
}

/// A map with some of everything that can be wrong.
MapData spoiltMap() {
  MapBuilder builder;
  builder.lane("a", {0, 0}, {100, 0}).lane("b", {101, 0}, {200, 0}).lane("c", {190, 0}, {300, 0});
  builder.lane("d", {0, 3.5}, {100, 3.5}).lane("e", {500, 0}, {600, 0}).lane("point", {700, 0}, {700, 0});
  builder.follow({"a", "b", "c"});
  builder["c"].successors = {"ghost", "e", "point"};
  builder["point"].predecessors = {"c"};
  builder["a"].right_forward = {"d", "e"};
  builder["b"].speed_limit = -1.0;
  builder["d"].type_statement = TypeStatement::kMissing;
  builder["e"].length = 7.0;
  builder.parkingSpace("p", {10, 10, 0.0}, 5.0, 2.5).parkingSpace("p", {20, 10, 0.0}, 5.0, 2.5);
  builder.data().parking_spaces.front().overlaps = {"ghost"};
  builder.area("bow", {{0, 20}, {10, 30}, {10, 20}, {0, 30}});
  return builder.data();
}

TEST(MapFindings, AreWhatTheWarningsCount) {
  EXPECT_TRUE(agree(spoiltMap()));
  std::set<MapFault> kinds;
  for (const MapFinding& finding : findingsOf(spoiltMap())) kinds.insert(finding.fault);
  EXPECT_GT(kinds.size(), 10u);
}

/// `count` of the same lanes, with ids of their own: "7/a".
MapData lanesOften(const MapData& once, std::size_t count) {
  MapData often;
  for (std::size_t i = 0; i < count; ++i) {
    for (LaneData lane : once.lanes) {
      const std::string prefix = std::to_string(i) + "/";
      lane.id = prefix + lane.id;
      for (auto* ids : {&lane.predecessors, &lane.successors, &lane.left_forward, &lane.right_forward}) {
        for (std::string& id : *ids) id = prefix + id;
      }
      for (Point2d& point : lane.center) point.y() += 1000.0 * static_cast<double>(i);
      often.lanes.push_back(std::move(lane));
    }
  }
  return often;
}

TEST(MapFindings, AreThoseOfEachPartOfALargeMapInTheOrderOfTheFile) {
  constexpr std::size_t kOften = 5000;  // so that several parts are looked at at once
  MapData once = spoiltMap();
  once.lanes.push_back(once.lanes.front());  // an id that is there already
  const std::vector<MapFinding> few = findingsOf(lanesOften(once, 1)), many = findingsOf(lanesOften(once, kOften));
  ASSERT_EQ(many.size(), kOften * few.size());
  std::map<MapFault, std::size_t> last, counts;
  for (const MapFinding& finding : few) counts[finding.fault] += kOften;
  for (const MapFinding& finding : many) {
    const std::size_t part = std::stoul(finding.ids.front());
    EXPECT_GE(part, last[finding.fault]) << finding.what;
    last[finding.fault] = part;
    --counts[finding.fault];
  }
  for (const auto& [fault, rest] : counts) EXPECT_EQ(rest, 0u) << kindOf(fault).what;
  EXPECT_TRUE(agree(lanesOften(once, kOften)));
}

TEST(MapFindings, AreWhatTheWarningsCountInRealMaps) {
  const std::vector<std::string> files = sharedMaps();
  if (files.empty()) GTEST_SKIP() << "no maps in " << EC_SHARED_DIR;
  for (const std::string& file : files) EXPECT_TRUE(agree(readMapData(file))) << file;
}

TEST(MapFindings, AreKeptWhereAskedForOnly) {
  const HdMap map(spoiltMap(), Point2d::Zero());
  EXPECT_FALSE(map.warnings().empty());
  EXPECT_TRUE(map.findings().empty());
}

TEST(MapFindings, NameTheObjectsAndThePlace) {
  for (const MapFinding& finding : findingsOf(spoiltMap())) {
    if (finding.fault != MapFault::kLinkGap) continue;
    EXPECT_EQ(finding.ids, (std::vector<std::string>{"a", "b"}));
    EXPECT_EQ(finding.place, Point2d(100.0, 0.0));
    EXPECT_NEAR(finding.size, 1.0, 1e-9);
    EXPECT_EQ(finding.what, "a to b, 1.00 m");
    return;
  }
  FAIL() << "the gap between a and b is not found";
}

TEST(MapFaultKinds, AreListedInTheirOrderWithNamesOfTheirOwn) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < mapFaultKinds().size(); ++i) {
    EXPECT_EQ(static_cast<std::size_t>(mapFaultKinds()[i].fault), i);
    EXPECT_TRUE(names.insert(mapFaultKinds()[i].name).second) << mapFaultKinds()[i].name;
  }
  EXPECT_EQ(kindOf(MapFault::kSpaceSmall).name, std::string("space_small"));
}

}  // namespace
}  // namespace external_command
