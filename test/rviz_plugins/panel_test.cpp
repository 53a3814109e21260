// SPDX-License-Identifier: Apache-2.0
// The panel with the gateway and the simulated vehicle: what a person presses, and what comes of it.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <QProgressBar>
#include <algorithm>
#include <cmath>

#include "external_command/PlanningCommand.h"
#include "panel_hand.h"
#include "support/inbox.h"

namespace external_command {
namespace {

constexpr double kStanding = 0.01;  // [m/s]

class PanelTest : public testing::Test {
 protected:
  void SetUp() override {
    panel_.show();
    ASSERT_TRUE(PanelHand::waitUntil([&] { return isReady(); })) << hand_.answers();
    hand_.press("auto");
    ASSERT_TRUE(PanelHand::waitUntil([&] { return mode() == Chassis::COMPLETE_AUTO_DRIVE; }));
    hand_.press("clear");
    ASSERT_TRUE(hand_.waitForAnswer("clear planning")) << hand_.answers();
    ASSERT_TRUE(waitUntilStanding());
  }

  /// The panel hears the vehicle, and so does the gateway.
  bool isReady() {
    const auto& state = gateway().state();
    return state.is_found && state.chassis && state.readiness && state.readiness->is_ready;
  }
  const GatewayLink& gateway() { return panel_.model().gateway(); }
  int mode() { return gateway().state().chassis ? gateway().state().chassis->driving_mode : -1; }
  double speed() { return gateway().state().chassis ? std::abs(gateway().state().chassis->speed_mps) : NAN; }
  bool waitUntilStanding() {
    return PanelHand::waitUntil([&] { return speed() < kStanding; });
  }
  bool waitUntilDriving() {
    return PanelHand::waitUntil([&] { return speed() > 1.0; });
  }
  static void drag(double x, double y, double heading) { Q_EMIT ToolHub::instance().goalDragged(x, y, heading); }
  static void click(double x, double y) { Q_EMIT ToolHub::instance().pointClicked(x, y); }

  /// Lane follow across the town, to the end that the vehicle is not at.
  void driveAcrossTown() {
    hand_.choose(CommandKind::kLaneFollow);
    drives_east_ = !drives_east_;
    drives_east_ ? drag(505.0, 194.75, 0.0) : drag(100.0, 205.25, M_PI);
    hand_.press("send");
    ASSERT_TRUE(hand_.waitForAnswer("lane follow")) << hand_.answers();
    ASSERT_TRUE(waitUntilDriving()) << hand_.answers();
  }

  /// Chooses the command, and waits for the list of what the map has for it.
  MapObject listedObject(CommandKind kind, const std::string& id) {
    hand_.choose(kind);
    const auto& objects = panel_.model().objects();
    const auto isIt = [&](const MapObject& object) { return object.id == id; };
    const bool is_listed = PanelHand::waitUntil([&] { return std::any_of(objects.begin(), objects.end(), isIt); });
    EXPECT_TRUE(is_listed) << id << " is not among " << objects.size() << " objects; " << hand_.answers();
    return is_listed ? *std::find_if(objects.begin(), objects.end(), isIt) : MapObject();
  }

  CommandPanel panel_;
  PanelHand hand_{&panel_};
  static bool drives_east_;
};

bool PanelTest::drives_east_ = false;

TEST_F(PanelTest, LaneFollowByDragDrivesThereAndFinishes) {
  driveAcrossTown();
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand_.text("running").find("RUNNING") != std::string::npos; }));
  EXPECT_TRUE(hand_.waitForAnswer("FINISHED: arrived")) << hand_.answers();
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand_.text("running").find("FINISHED") != std::string::npos; }));
}

TEST_F(PanelTest, StopStopsTheVehicleAndStartLetsItGoOn) {
  driveAcrossTown();
  hand_.press("stop");
  EXPECT_TRUE(waitUntilStanding()) << hand_.answers();
  EXPECT_TRUE(hand_.answersHold("STOP"));
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand_.text("running").find("RUNNING") != std::string::npos; }))
      << "it is held, not ended";
  hand_.press("start");
  EXPECT_TRUE(waitUntilDriving()) << hand_.answers();
}

TEST_F(PanelTest, ClearEndsTheCommand) {
  driveAcrossTown();
  hand_.press("clear");
  EXPECT_TRUE(hand_.waitForAnswer("CANCELLED (12)")) << hand_.answers();
  EXPECT_TRUE(waitUntilStanding());
}

TEST_F(PanelTest, TheModeIsShownAndSwitched) {
  hand_.press("manual");
  EXPECT_TRUE(PanelHand::waitUntil([&] { return mode() == Chassis::COMPLETE_MANUAL; })) << hand_.answers();
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand_.text("mode").find("manual") != std::string::npos; }));
  hand_.press("auto");
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand_.text("mode").find("auto") != std::string::npos; }));
}

TEST_F(PanelTest, ADryRunShowsItsPathAndSendsNothing) {
  Inbox<visualization_msgs::MarkerArray> drafts("external_command/draft");
  const auto showsPath = [](const visualization_msgs::MarkerArray& array) {
    return std::any_of(array.markers.begin(), array.markers.end(), [](const visualization_msgs::Marker& marker) {
      return marker.ns == "draft_path" && marker.action == visualization_msgs::Marker::ADD && marker.points.size() > 10;
    });
  };
  Inbox<PlanningCommand> commands("planning/command");
  hand_.choose(CommandKind::kLaneFollow);
  drag(300.0, 194.75, 0.0);
  hand_.press("dry_run");
  EXPECT_TRUE(hand_.waitForAnswer("lane follow, dry run", "path ")) << hand_.answers();
  EXPECT_TRUE(drafts.waitFor(1, showsPath));
  for (const PlanningCommand& command : commands.messages()) EXPECT_FALSE(command.is_motion_command);
  EXPECT_LT(speed(), kStanding);
}

TEST_F(PanelTest, AWrongRequestShowsCodeAndReason) {
  hand_.choose(CommandKind::kLaneFollow);
  drag(5000.0, 5000.0, 0.0);
  hand_.press("send");
  EXPECT_TRUE(hand_.waitForAnswer("OFF_MAP (6)")) << hand_.answers();
  EXPECT_TRUE(hand_.answersHold("nearest lane")) << hand_.answers();
  EXPECT_LT(speed(), kStanding);
}

TEST_F(PanelTest, WhatIsMissingIsNotSent) {
  hand_.choose(CommandKind::kPathFollow);
  click(100.0, 100.0);
  hand_.press("send");
  EXPECT_TRUE(hand_.answersHold("at least 2 points")) << hand_.answers();
}

TEST_F(PanelTest, TheSpeedOfTheRunningCommandIsChanged) {
  driveAcrossTown();
  hand_.press("set_speed");
  EXPECT_TRUE(hand_.waitForAnswer("speed")) << hand_.answers();
}

TEST_F(PanelTest, ProgressIsShownWhileItDrives) {
  driveAcrossTown();
  const auto* const bar = hand_.widget<QProgressBar>("progress");
  EXPECT_TRUE(PanelHand::waitUntil([&] { return bar->value() > 50 && bar->value() < 1000; }));
  EXPECT_NE(hand_.text("left").find(" left, "), std::string::npos) << hand_.text("left");
  EXPECT_NE(hand_.text("running").find("lane follow"), std::string::npos) << hand_.text("running");
}

TEST_F(PanelTest, WhoComesLateSeesWhatIsDriven) {
  driveAcrossTown();
  CommandPanel late;
  const PanelHand watch(&late);
  EXPECT_TRUE(PanelHand::waitUntil([&] { return watch.text("running").find("lane follow") != std::string::npos; }))
      << watch.text("running");
}

TEST_F(PanelTest, ReadinessIsTold) {
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand_.text("readiness").find("Ready") != std::string::npos; }))
      << hand_.text("readiness");
}

TEST_F(PanelTest, ValetByClickOnASpaceParksThere) {
  const MapObject space = listedObject(CommandKind::kValetParking, "n_out_5");
  click(space.pose.x, space.pose.y);
  ASSERT_TRUE(PanelHand::waitUntil([&] { return panel_.model().draft().object_id == "n_out_5"; })) << hand_.answers();
  hand_.press("send");
  EXPECT_TRUE(hand_.waitForAnswer("FINISHED: arrived")) << hand_.answers();
}

TEST_F(PanelTest, ASpaceIsChosenFromTheListToo) {
  listedObject(CommandKind::kValetParking, "n_out_7");
  EXPECT_NE(hand_.widget<QComboBox>("object")->findText("n_out_7"), -1);
  hand_.write("object", "n_out_7");
  hand_.press("dry_run");
  EXPECT_TRUE(hand_.waitForAnswer("valet parking, dry run", "path ")) << hand_.answers();
}

TEST_F(PanelTest, AClickBesideEverySpaceIsTold) {
  listedObject(CommandKind::kValetParking, "n_out_5");
  click(150.0, 300.0);
  EXPECT_TRUE(hand_.waitForAnswer("no parking space within 5 m of (150.0, 300.0)")) << hand_.answers();
  EXPECT_TRUE(panel_.model().draft().object_id.empty());
}

TEST_F(PanelTest, AZoneByClickIsPlanned) {
  const MapObject area = listedObject(CommandKind::kZoneCover, "yard");
  click(area.pose.x, area.pose.y);
  ASSERT_TRUE(PanelHand::waitUntil([&] { return panel_.model().draft().object_id == "yard"; })) << hand_.answers();
  hand_.press("dry_run");
  EXPECT_TRUE(hand_.waitForAnswer("zone cover, dry run", "% covered")) << hand_.answers();
}

TEST_F(PanelTest, APathByClickedPointsIsPlanned) {
  hand_.choose(CommandKind::kPathFollow);
  for (const double x : {100.0, 140.0, 900.0, 180.0}) {
    click(x, 195.0);
    if (x > 500.0) hand_.press("undo_point");
  }
  EXPECT_EQ(hand_.text("points"), "3 points");
  hand_.press("dry_run");
  EXPECT_TRUE(hand_.waitForAnswer("path follow, dry run", "path ")) << hand_.answers();
  EXPECT_TRUE(hand_.answersHold("path 80 m")) << hand_.answers();
  hand_.press("clear_points");
  EXPECT_EQ(hand_.text("points"), "0 points");
}

TEST_F(PanelTest, PosesByDragArePlanned) {
  hand_.choose(CommandKind::kPreciseParking);
  drag(322.0, 110.0, 0.0);
  hand_.press("dry_run");
  EXPECT_TRUE(hand_.waitForAnswer("precise parking, dry run", "path ")) << hand_.answers();
  hand_.choose(CommandKind::kFreeSpace);
  hand_.press("dry_run");
  EXPECT_TRUE(hand_.waitForAnswer("free space, dry run", "path ")) << hand_.answers();
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "panel_test");
  const ros::NodeHandle keeps_ros;
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
