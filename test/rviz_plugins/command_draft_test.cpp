// SPDX-License-Identifier: Apache-2.0
#include "rviz_plugins/command_draft.h"

#include <gtest/gtest.h>

#include "rviz_plugins/draft_markers.h"

namespace external_command {
namespace {

using visualization_msgs::Marker;

CommandDraft draftOf(CommandKind kind) {
  CommandDraft draft;
  draft.kind = kind;
  return draft;
}

Pose pose(double x, double y, double heading, bool has_heading) {
  Pose made;
  made.x = x;
  made.y = y;
  made.heading = heading;
  made.has_heading = has_heading;
  return made;
}

geometry_msgs::Point point(double x, double y) {
  geometry_msgs::Point made;
  made.x = x;
  made.y = y;
  return made;
}

Marker markerOf(const visualization_msgs::MarkerArray& array, const std::string& ns) {
  for (const Marker& marker : array.markers) {
    if (marker.ns == ns) return marker;
  }
  ADD_FAILURE() << "no marker in namespace " << ns;
  return {};
}

TEST(CommandDraft, OfEachKindTellsWhatIsMissing) {
  for (const CommandKindWords& known : kCommandKinds) {
    EXPECT_FALSE(draftOf(known.kind).missing().isEmpty()) << known.name;
    EXPECT_EQ(&known - kCommandKinds.data(), static_cast<int>(known.kind)) << "they are in the order of the kinds";
  }
}

TEST(CommandDraft, OfLaneFollowNeedsAGoalButNoHeading) {
  CommandDraft draft = draftOf(CommandKind::kLaneFollow);
  draft.goal = pose(1.0, 2.0, 0.0, false);
  EXPECT_TRUE(draft.missing().isEmpty());
}

TEST(CommandDraft, OfPrecisePoseNeedsAHeading) {
  for (const CommandKind kind : {CommandKind::kFreeSpace, CommandKind::kPreciseParking}) {
    CommandDraft draft = draftOf(kind);
    draft.goal = pose(1.0, 2.0, 0.0, false);
    EXPECT_NE(draft.missing().indexOf("heading"), -1);
    draft.goal->has_heading = true;
    EXPECT_TRUE(draft.missing().isEmpty());
  }
}

TEST(CommandDraft, OfParkingAndZonesNeedsTheirPlace) {
  for (const CommandKind kind : {CommandKind::kValetParking, CommandKind::kZoneCover}) {
    CommandDraft draft = draftOf(kind);
    draft.goal = pose(1.0, 2.0, 0.0, true);
    EXPECT_FALSE(draft.missing().isEmpty());
    draft.object_id = "here";
    EXPECT_TRUE(draft.missing().isEmpty());
  }
}

TEST(CommandDraft, OfAPathNeedsTwoPoints) {
  CommandDraft draft = draftOf(CommandKind::kPathFollow);
  draft.points = {point(0.0, 0.0)};
  EXPECT_FALSE(draft.missing().isEmpty());
  draft.points.push_back(point(10.0, 0.0));
  EXPECT_TRUE(draft.missing().isEmpty());
}

TEST(DraftMarkers, ShowGoalAndWayPoints) {
  CommandDraft draft = draftOf(CommandKind::kLaneFollow);
  draft.goal = pose(3.0, 4.0, 1.0, true);
  draft.points = {point(1.0, 1.0)};
  auto array = draftMarkers(draft, std::nullopt, {});
  EXPECT_EQ(markerOf(array, "draft_goal").action, Marker::ADD);
  EXPECT_EQ(markerOf(array, "draft_goal").type, Marker::ARROW);
  EXPECT_DOUBLE_EQ(markerOf(array, "draft_goal").pose.position.x, 3.0);
  EXPECT_EQ(markerOf(array, "draft_points").points.size(), 1u);
  EXPECT_EQ(markerOf(array, "draft_path").action, Marker::DELETE);
  draft.goal->has_heading = false;
  EXPECT_EQ(markerOf(draftMarkers(draft, std::nullopt, {}), "draft_goal").type, Marker::SPHERE);
  draft.kind = CommandKind::kValetParking;
  array = draftMarkers(draft, std::nullopt, {});
  EXPECT_EQ(markerOf(array, "draft_goal").action, Marker::DELETE) << "it has no goal of its own";
  EXPECT_EQ(markerOf(array, "draft_points").action, Marker::DELETE);
}

TEST(DraftMarkers, ShowTheOutlineOfTheChosenObjectAlone) {
  CommandDraft draft = draftOf(CommandKind::kValetParking);
  draft.object_id = "space";
  MapObject object;
  object.kind = MapObject::PARKING_SPACE;
  object.id = "space";
  object.outline = {point(0.0, 0.0), point(5.0, 0.0), point(5.0, 2.5), point(0.0, 2.5)};
  EXPECT_EQ(markerOf(draftMarkers(draft, object, {}), "draft_object").points.size(), 8u);
  object.id = "another";
  EXPECT_EQ(markerOf(draftMarkers(draft, object, {}), "draft_object").action, Marker::DELETE);
}

TEST(DraftMarkers, ShowALongPathWithAFewThousandPointsUpToItsEnd) {
  PlannedPath path;
  path.points.resize(123456);
  for (std::size_t i = 0; i < path.points.size(); ++i) path.points[i].x = static_cast<double>(i);
  const Marker drawn = markerOf(draftMarkers(draftOf(CommandKind::kLaneFollow), std::nullopt, path), "draft_path");
  EXPECT_EQ(drawn.action, Marker::ADD);
  EXPECT_LE(drawn.points.size(), 12000u);
  EXPECT_EQ(drawn.points.size(), drawn.colors.size());
  ASSERT_FALSE(drawn.points.empty());
  EXPECT_DOUBLE_EQ(drawn.points.back().x, 123455.0);
}

TEST(DraftMarkers, ShowNoPathOfLessThanTwoPoints) {
  PlannedPath path;
  path.points.resize(1);
  EXPECT_EQ(markerOf(draftMarkers({}, std::nullopt, path), "draft_path").action, Marker::DELETE);
}

}  // namespace
}  // namespace external_command
