// SPDX-License-Identifier: Apache-2.0
// A command is cancelled while it is planned or driven, and no other is touched.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <string>
#include <vector>

#include "external_command/Action.h"
#include "external_command/CancelCommand.h"
#include "external_command/GetCommandStatus.h"
#include "external_command/PlanningCommand.h"
#include "external_command/PlanningPad.h"
#include "support/blocking_nodelets.h"
#include "support/inbox.h"
#include "support/localization.h"
#include "support/motion_calls.h"
#include "support/nodelet_manager.h"

namespace external_command {
namespace {

constexpr double kLatest = 0.1;  // [s]
constexpr const char* kOtherService = "/other/test/plan";

bool isMotion(const PlanningCommand& command) { return command.is_motion_command; }
bool isWithdrawal(const PlanningCommand& command) { return !command.is_motion_command; }

/// The component, and a planner that plans until the test lets it go on.
class Cancel : public testing::Test {
 protected:
  void SetUp() override {
    manager_.provide("test/BlockingPlanner", &planner_);
    ASSERT_TRUE(manager_.load("external_command", "external_command/ExternalCommandProcessComponent"));
    ASSERT_TRUE(manager_.load("planner", "test/BlockingPlanner"));
    ASSERT_TRUE(ros::service::waitForService("external_command/cancel_command", 10000));
    ASSERT_TRUE(ros::service::waitForService(BlockingPlanner::kService, 10000));
  }

  void TearDown() override { manager_.clear(); }

  /// A plan in work, which ends when its gate is opened.
  struct HeldPlan {
    std::shared_ptr<TestGate> gate;
    std::future<CommandStatus> status;
  };

  /// @param polls_cancel  it ends where it is cancelled, too.
  HeldPlan startHeldPlan(std::int64_t command_id, bool polls_cancel,
                         const std::string& service = BlockingPlanner::kService) {
    HeldPlan held{planner_->holdPlans(polls_cancel), plan(command_id, false, service)};
    EXPECT_TRUE(held.gate->waitForEntered(1));
    return held;
  }

  /// Another vehicle of this process plans, and has one of the two threads.
  HeldPlan startPlanOfOtherVehicle() {
    XmlRpc::XmlRpcValue vehicle;
    EXPECT_TRUE(ros::param::get(ros::names::resolve("external_command/vehicle"), vehicle));
    ros::param::set("/other/external_command/vehicle", vehicle);
    const auto planner = planner_;
    EXPECT_TRUE(manager_.load("/other/planner", "test/BlockingPlanner"));
    EXPECT_TRUE(ros::service::waitForService(kOtherService, 10000));
    HeldPlan held = startHeldPlan(1, false, kOtherService);
    planner_ = planner;
    return held;
  }

  static CancelCommand::Response cancel(std::int64_t command_id) {
    CancelCommand call;
    call.request.command_id = command_id;
    EXPECT_TRUE(ros::service::call("external_command/cancel_command", call));
    return call.response;
  }

  /// Calls the planner; the answer comes when its gate is open.
  static std::future<CommandStatus> plan(std::int64_t command_id, bool dry_run = false,
                                         const std::string& service = BlockingPlanner::kService) {
    return std::async(std::launch::async, [=] {
      PathFollow call;
      call.request.command.command_id = command_id;
      call.request.command.dry_run = dry_run;
      EXPECT_TRUE(ros::service::call(service, call));
      return call.response.status;
    });
  }

  /// A command that is driven.
  CommandStatus drive(std::int64_t command_id) {
    planner_->holdPlans(true)->open();
    const CommandStatus status = plan(command_id).get();
    EXPECT_EQ(status.status, CommandStatus::RUNNING) << status.message;
    return status;
  }

  void expectCancelled(const CommandStatus& status, std::int64_t command_id) {
    EXPECT_EQ(status.command_id, command_id);
    EXPECT_EQ(status.status, CommandStatus::ERROR);
    EXPECT_EQ(status.error_code, CommandStatus::CANCELLED);
    EXPECT_NE(status.message.find("cancelled by cancel_command"), std::string::npos) << status.message;
  }

  boost::shared_ptr<BlockingPlanner> planner_;
  NodeletManager manager_;
};

TEST_F(Cancel, EndsAPlanThatPollsItsToken) {
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(7);
  ASSERT_TRUE(gate->waitForEntered(1));
  const CancelCommand::Response answer = cancel(7);
  EXPECT_TRUE(answer.was_running);
  expectCancelled(answer.status, 7);
  EXPECT_TRUE(gate->waitForLeft(1)) << "though nobody opened the gate";
  expectCancelled(planned.get(), 7);
}

TEST_F(Cancel, LeavesAPlanAloneWhereANewerCommandIsRefused) {
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(7);
  ASSERT_TRUE(gate->waitForEntered(1));
  FreeSpace free_space;
  free_space.request.command.header.frame_id = "nonsense";
  free_space.request.command.parking_spot_pose.has_heading = 1;
  ASSERT_TRUE(ros::service::call("external_command/free_space", free_space));
  EXPECT_EQ(free_space.response.status.error_code, CommandStatus::INVALID_REQUEST);
  ZoneCover zone_cover;
  zone_cover.request.command.drivable_roi = bowTie();
  ASSERT_TRUE(ros::service::call("external_command/zone_cover", zone_cover));
  EXPECT_EQ(zone_cover.response.status.error_code, CommandStatus::INVALID_REQUEST);
  EXPECT_NE(zone_cover.response.status.message.find("drivable_roi"), std::string::npos);
  gate->open();
  EXPECT_EQ(planned.get().status, CommandStatus::RUNNING);
}

TEST_F(Cancel, LeavesAPlanAloneWhereANewerCommandCannotBePlanned) {
  const Localization localization;
  localization.place(*planner_, 0.0);
  HeldPlan older = startHeldPlan(7, true);

  localization.place(*planner_, 0.0);
  EXPECT_EQ(statusOf(driveStraightOnTo(5e8)).error_code, CommandStatus::INVALID_REQUEST);
  FreeSpace goal_blocked = driveStraightOnTo(20.0);
  goal_blocked.request.command.non_drivable_roi = {boxOf(18.0, -1.0, 22.0, 1.0)};
  EXPECT_EQ(statusOf(goal_blocked).error_code, CommandStatus::GOAL_BLOCKED);
  FreeSpace start_blocked = driveStraightOnTo(20.0);
  start_blocked.request.command.drivable_roi = boxOf(10.0, -5.0, 40.0, 5.0);
  EXPECT_EQ(statusOf(start_blocked).error_code, CommandStatus::START_BLOCKED);

  localization.place(*planner_, 0.0);
  ZoneCover narrow;
  narrow.request.command.drivable_roi = boxOf(-20.0, -0.3, 20.0, 0.3);
  EXPECT_EQ(statusOf(narrow).error_code, CommandStatus::INVALID_REQUEST);
  ZoneCover elsewhere;
  elsewhere.request.command.drivable_roi = boxOf(30.0, 30.0, 60.0, 60.0);
  EXPECT_EQ(statusOf(elsewhere).error_code, CommandStatus::START_BLOCKED);
  ZoneCover never_begun;
  never_begun.request.command.drivable_roi = boxOf(-20.0, -20.0, 20.0, 20.0);
  never_begun.request.command.resume = 1;
  EXPECT_EQ(statusOf(never_begun).error_code, CommandStatus::INVALID_REQUEST);

  localization.place(*planner_, 0.0);
  older.gate->open();
  const CommandStatus status = older.status.get();
  EXPECT_EQ(status.status, CommandStatus::RUNNING) << status.message;
}

TEST_F(Cancel, EndsAPlanWhereANewerCommandCanBePlanned) {
  const Localization localization;
  localization.place(*planner_, 0.0);
  HeldPlan older = startHeldPlan(7, true);
  localization.place(*planner_, 0.0);
  const CommandStatus newer = statusOf(driveStraightOnTo(20.0));
  EXPECT_EQ(newer.status, CommandStatus::RUNNING) << newer.message;
  EXPECT_TRUE(older.gate->waitForLeft(1)) << "though nobody opened the gate";
  older.gate->open();
  EXPECT_EQ(older.status.get().error_code, CommandStatus::SUPERSEDED);
}

TEST_F(Cancel, WithdrawsAMotionFromTheTopicThatTheNextOneDoesNotUse) {
  ros::param::set(ros::names::resolve("follower") + "/output_command_name", std::vector<std::string>{"other/command"});
  ASSERT_TRUE(manager_.load("follower", "external_command/PathFollowCommandProcessor"));
  ASSERT_TRUE(ros::service::waitForService("external_command/path_follow", 10000));
  Inbox<PlanningCommand> commands("planning/command");
  Inbox<PlanningCommand> others("other/command");
  const CommandStatus first = drive(7);
  PathFollow next;
  next.request.command.way_point.resize(2);
  next.request.command.way_point[1].x = 10.0;
  ASSERT_TRUE(ros::service::call("external_command/path_follow", next));
  EXPECT_EQ(next.response.status.status, CommandStatus::RUNNING) << next.response.status.message;
  ASSERT_TRUE(others.waitFor(1, isMotion));
  ASSERT_TRUE(commands.waitFor(1, isWithdrawal));
  EXPECT_EQ(commands.messages().back().command_id, first.command_id);
  EXPECT_FALSE(commands.messages().back().is_motion_command) << "who subscribes later must not drive it";
}

TEST_F(Cancel, LeavesNoActionRunningWhoseProcessorIsUnloaded) {
  ASSERT_TRUE(manager_.load("action", "external_command/ActionCommandProcessor"));
  ASSERT_TRUE(ros::service::waitForService("external_command/action", 10000));
  Action pull_over;
  pull_over.request.command.command = ActionCommand::PULL_OVER;
  ASSERT_TRUE(ros::service::call("external_command/action", pull_over));
  EXPECT_EQ(pull_over.response.status.status, CommandStatus::RUNNING) << pull_over.response.status.message;
  ASSERT_TRUE(manager_.unload("action"));
  GetCommandStatus asked;
  asked.request.command_id = pull_over.response.status.command_id;
  ASSERT_TRUE(ros::service::call("external_command/command_status", asked));
  EXPECT_EQ(asked.response.status.status, CommandStatus::UNKNOWN);
  EXPECT_NE(asked.response.status.message.find("unloaded"), std::string::npos) << asked.response.status.message;
}

TEST_F(Cancel, KeepsAPlanFromBeingSentThatDoesNotNotice) {
  Inbox<PlanningCommand> commands("planning/command");
  const auto gate = planner_->holdPlans(false);
  auto planned = plan(7);
  ASSERT_TRUE(gate->waitForEntered(1));
  EXPECT_TRUE(cancel(7).was_running);
  gate->open();
  expectCancelled(planned.get(), 7);
  const CommandStatus next = drive(8);
  ASSERT_TRUE(commands.waitFor(1));
  EXPECT_EQ(commands.messages().front().command_id, next.command_id) << "the first that arrives";
}

TEST_F(Cancel, EndsWhatWaitsForAThread) {
  HeldPlan older = startHeldPlan(1, false);
  HeldPlan newer = startHeldPlan(2, false);
  Inbox<CommandStatus> statuses("external_command/status");
  auto waiting = plan(7);
  ASSERT_TRUE(statuses.waitFor(1, [](const CommandStatus& status) { return status.command_id == 7; }));
  EXPECT_TRUE(cancel(7).was_running);
  expectCancelled(waiting.get(), 7);
  older.gate->open();
  newer.gate->open();
}

TEST_F(Cancel, EndsAnOlderPlanThoughTheNewerWaitsForAThreadThatAnotherVehicleHas) {
  HeldPlan others = startPlanOfOtherVehicle();
  HeldPlan older = startHeldPlan(7, true);
  const auto newer_gate = planner_->holdPlans(true);
  newer_gate->open();
  auto newer = plan(8);
  EXPECT_TRUE(older.gate->waitForLeft(1)) << "though nobody opened the gate";
  older.gate->open();
  EXPECT_EQ(older.status.get().error_code, CommandStatus::SUPERSEDED);
  EXPECT_EQ(newer.get().status, CommandStatus::RUNNING);
  others.gate->open();
  EXPECT_EQ(others.status.get().status, CommandStatus::RUNNING) << "no vehicle cancels what another plans";
}

TEST_F(Cancel, LeavesAnOlderPlanAloneWhereTheNewerThatWaitsForAThreadHasNoRoute) {
  HeldPlan others = startPlanOfOtherVehicle();
  HeldPlan older = startHeldPlan(7, true);
  planner_->setHasRoute(false);
  auto newer = plan(8);
  EXPECT_EQ(newer.wait_for(std::chrono::seconds(10)), std::future_status::ready) << "though nobody opened a gate";
  older.gate->open();
  EXPECT_EQ(newer.get().error_code, CommandStatus::NO_ROUTE);
  EXPECT_EQ(older.status.get().status, CommandStatus::RUNNING);
  others.gate->open();
  others.status.get();
}

TEST_F(Cancel, ByAStopEndsWhatIsPlannedAndWhatWaitsForAThread) {
  ASSERT_TRUE(manager_.load("action", "external_command/ActionCommandProcessor"));
  ASSERT_TRUE(ros::service::waitForService("external_command/action", 10000));
  HeldPlan others = startPlanOfOtherVehicle();
  HeldPlan older = startHeldPlan(7, false);
  Inbox<CommandStatus> statuses("external_command/status");
  auto waiting = plan(8);
  ASSERT_TRUE(statuses.waitFor(1, [](const CommandStatus& status) { return status.command_id == 8; }));
  Action stop;
  stop.request.command.command = ActionCommand::STOP;
  ASSERT_TRUE(ros::service::call("external_command/action", stop));
  EXPECT_EQ(waiting.get().error_code, CommandStatus::CANCELLED) << "while no thread is free";
  older.gate->open();
  EXPECT_EQ(older.status.get().status, CommandStatus::ERROR) << "neither is sent";
  others.gate->open();
  EXPECT_EQ(others.status.get().status, CommandStatus::RUNNING) << "it is the stop of one vehicle";
}

TEST_F(Cancel, EndsADryRun) {
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(7, true);
  ASSERT_TRUE(gate->waitForEntered(1));
  EXPECT_TRUE(cancel(7).was_running);
  expectCancelled(planned.get(), 7);
}

TEST_F(Cancel, IsAnsweredAtOnceWhileAsMuchAsCanBeIsPlanned) {
  HeldPlan older = startHeldPlan(1, false);
  HeldPlan newer = startHeldPlan(2, false);
  std::vector<std::future<CommandStatus>> waiting;
  for (int i = 3; i <= 8; ++i) waiting.push_back(plan(i));
  double slowest = 0.0;
  for (int i = 0; i < 50; ++i) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    cancel(1);
    slowest = std::max(slowest, (ros::SteadyTime::now() - begin).toSec());
  }
  EXPECT_LT(slowest, kLatest);
  older.gate->open();
  newer.gate->open();
}

TEST_F(Cancel, ClearsTheMotionThatIsDriven) {
  Inbox<PlanningCommand> commands("planning/command");
  Inbox<PlanningPad> pads("planning/pad");
  drive(7);
  ASSERT_TRUE(commands.waitFor(1, &isMotion));
  const CancelCommand::Response answer = cancel(7);
  EXPECT_TRUE(answer.was_running);
  expectCancelled(answer.status, 7);
  ASSERT_TRUE(pads.waitFor(1));
  EXPECT_EQ(pads.messages().front().action, PlanningPad::CLEAR_PLANNING);
  EXPECT_GT(pads.messages().front().header.stamp, commands.messages().front().header.stamp);
  ASSERT_TRUE(commands.waitFor(1, &isWithdrawal));
  EXPECT_EQ(commands.messages().back().command_id, 7);

  const CancelCommand::Response again = cancel(7);
  EXPECT_FALSE(again.was_running);
  expectCancelled(again.status, 7);
  drive(8);
  ASSERT_TRUE(commands.waitFor(2, &isMotion));
  EXPECT_EQ(pads.messages().size(), 1u) << "it is cleared once";
}

TEST_F(Cancel, LeavesTheMotionThatIsDrivenAloneWhereANewerIsPlanned) {
  Inbox<PlanningPad> pads("planning/pad");
  drive(7);
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(8);
  ASSERT_TRUE(gate->waitForEntered(1));
  EXPECT_TRUE(cancel(8).was_running);
  expectCancelled(planned.get(), 8);
  const CancelCommand::Response first = cancel(7);
  EXPECT_TRUE(first.was_running) << first.status.message;
  ASSERT_TRUE(pads.waitFor(1));
  EXPECT_EQ(pads.messages().size(), 1u) << "that of the one that was driven";
}

TEST_F(Cancel, DoesNotEndTheNewerCommandThatIsPlannedWhileTheDrivenOneIsCleared) {
  Inbox<PlanningCommand> commands("planning/command");
  Inbox<PlanningPad> pads("planning/pad");
  drive(7);
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(8);
  ASSERT_TRUE(gate->waitForEntered(1));
  EXPECT_TRUE(cancel(7).was_running);
  gate->open();
  EXPECT_EQ(planned.get().status, CommandStatus::RUNNING);
  ASSERT_TRUE(commands.waitFor(2, &isMotion));
  ASSERT_TRUE(pads.waitFor(1));
  EXPECT_LE(pads.messages().front().header.stamp, commands.messages().back().header.stamp)
      << "a planner that hears of both in another order drives the newer one";
}

TEST_F(Cancel, ClearsNothingForACommandThatWasSuperseded) {
  Inbox<PlanningPad> pads("planning/pad");
  drive(7);
  drive(8);
  const CancelCommand::Response answer = cancel(7);
  EXPECT_FALSE(answer.was_running);
  EXPECT_EQ(answer.status.error_code, CommandStatus::SUPERSEDED) << answer.status.message;
  EXPECT_TRUE(cancel(8).was_running);
  ASSERT_TRUE(pads.waitFor(1));
  EXPECT_EQ(pads.messages().size(), 1u);
}

TEST_F(Cancel, MeansTheNewestCommandByAnId) {
  drive(7);
  EXPECT_TRUE(cancel(7).was_running);
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(7);
  ASSERT_TRUE(gate->waitForEntered(1));
  EXPECT_TRUE(cancel(7).was_running);
  expectCancelled(planned.get(), 7);
}

TEST_F(Cancel, SaysThatItKnowsNoSuchCommand) {
  const CancelCommand::Response answer = cancel(4711);
  EXPECT_FALSE(answer.was_running);
  EXPECT_EQ(answer.status.status, CommandStatus::UNKNOWN);
  EXPECT_EQ(answer.status.error_code, CommandStatus::UNKNOWN_ID) << answer.status.message;
  EXPECT_EQ(answer.status.command_id, 4711);
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "cancel_planning_test");
  const ros::NodeHandle nh;  // keeps ROS running between the tests
  return RUN_ALL_TESTS();
}
