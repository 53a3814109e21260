// SPDX-License-Identifier: Apache-2.0
// A stop gets through whatever the process is busy with, and nothing that was planned before it leaves after it.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <algorithm>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "external_command/Action.h"
#include "external_command/Chassis.h"
#include "external_command/ControlPad.h"
#include "external_command/PlanningCommand.h"
#include "external_command/PlanningPad.h"
#include "external_command/RoutingRequest.h"
#include "external_command/RoutingResponse.h"
#include "support/blocking_nodelets.h"
#include "support/comes_true.h"
#include "support/inbox.h"
#include "support/localization.h"
#include "support/nodelet_manager.h"

namespace external_command {
namespace {

#ifdef __SANITIZE_THREAD__
constexpr double kLatest = 1.0;  // [s]; each access to memory takes some ten times as long
#else
constexpr double kLatest = 0.1;  // [s]
#endif

/// A nodelet manager in this process, with the action processor and two nodelets of the test.
class Stop : public testing::Test {
 protected:
  void SetUp() override {
    manager_.provide("test/WorkerBlocker", &blocker_);
    manager_.provide("test/BlockingPlanner", &planner_);
    manager_.provide("test/BlockingLaneFollow", &lane_follow_);
    manager_.provide("test/ThrowingProcessor", [] { return boost::make_shared<ThrowingProcessor>(); });
    ASSERT_TRUE(manager_.load("action_command_processor", "external_command/ActionCommandProcessor"));
    ASSERT_TRUE(manager_.load("planner", "test/BlockingPlanner"));
    ASSERT_TRUE(manager_.load("blocker", "test/WorkerBlocker"));
    ASSERT_TRUE(ros::service::waitForService("external_command/action", 10000));
    ASSERT_TRUE(ros::service::waitForService(BlockingPlanner::kService, 10000));
  }

  void TearDown() override {
    if (workers_) workers_->open();
    manager_.clear();
  }

  /// Occupies each worker thread of the manager, and queues more for each.
  void blockEveryWorker() {
    const unsigned workers = std::max(1u, std::thread::hardware_concurrency());
    workers_ = std::make_shared<TestGate>();
    blocker_->block(workers_, 4 * workers);
    ASSERT_TRUE(workers_->waitForEntered(workers));
  }

  static CommandStatus send(std::uint8_t action, std::int64_t command_id = 0) {
    Action call;
    call.request.command.command = action;
    call.request.command.command_id = command_id;
    EXPECT_TRUE(ros::service::call("external_command/action", call));
    return call.response.status;
  }

  /// Calls the planner; the answer comes when its gate is open.
  static std::future<CommandStatus> plan(std::int64_t command_id = 0) {
    return std::async(std::launch::async, [command_id] {
      PathFollow call;
      call.request.command.command_id = command_id;
      EXPECT_TRUE(ros::service::call(BlockingPlanner::kService, call));
      return call.response.status;
    });
  }

  /// Times from a call [s].
  struct Delay {
    double answer = 0.0;   ///< until it is answered
    double arrival = 0.0;  ///< until what it sends has arrived
  };

  /// Sends `action` while a plan is running.
  template <class Pad>
  Delay measure(std::uint8_t action, std::uint8_t pad, Inbox<Pad>* inbox) {
    const auto gate = planner_->holdPlans(true);
    auto planned = plan();
    EXPECT_TRUE(gate->waitForEntered(1));
    const std::size_t seen = inbox->messages().size();
    const ros::SteadyTime begin = ros::SteadyTime::now();
    const CommandStatus status = send(action);
    Delay delay;
    delay.answer = (ros::SteadyTime::now() - begin).toSec();
    EXPECT_TRUE(inbox->waitFor(seen + 1));
    delay.arrival = (ros::SteadyTime::now() - begin).toSec();
    EXPECT_NE(status.status, CommandStatus::ERROR) << status.message;
    EXPECT_EQ(inbox->messages().back().action, pad);
    EXPECT_EQ(planned.get().error_code, CommandStatus::CANCELLED);
    return delay;
  }

  /// Sends `action` 50 times while every worker is blocked and a plan is running.
  template <class Pad>
  void expectPromptness(std::uint8_t action, std::uint8_t pad, Inbox<Pad>* inbox) {
    std::vector<double> answers, arrivals;
    for (int i = 0; i < 50; ++i) {
      const Delay delay = measure(action, pad, inbox);
      answers.push_back(delay.answer);
      arrivals.push_back(delay.arrival);
    }
    std::sort(answers.begin(), answers.end());
    std::sort(arrivals.begin(), arrivals.end());
    std::printf("answered in %.1f ms (slowest %.1f), arrived in %.1f ms (slowest %.1f)\n", 1e3 * answers[25],
                1e3 * answers.back(), 1e3 * arrivals[25], 1e3 * arrivals.back());
    EXPECT_LT(answers.back(), kLatest);
    EXPECT_LT(arrivals.back(), kLatest);
    EXPECT_EQ(workers_->entered(), std::max(1u, std::thread::hardware_concurrency())) << "the workers were blocked";
  }

  boost::shared_ptr<WorkerBlocker> blocker_;
  boost::shared_ptr<BlockingPlanner> planner_;
  boost::shared_ptr<BlockingLaneFollow> lane_follow_;
  std::shared_ptr<TestGate> workers_;
  NodeletManager manager_;
};

TEST_F(Stop, IsAnsweredAndSentWhileEveryWorkerIsBlockedAndAPlanIsRunning) {
  Inbox<PlanningPad> pads("planning/pad");
  blockEveryWorker();
  expectPromptness(ActionCommand::STOP, PlanningPad::STOP, &pads);
}

TEST_F(Stop, IsAsPromptAsClearPlanning) {
  Inbox<PlanningPad> pads("planning/pad");
  blockEveryWorker();
  expectPromptness(ActionCommand::CLEAR_PLANNING, PlanningPad::CLEAR_PLANNING, &pads);
}

TEST_F(Stop, IsAsPromptAsTheSwitchToManual) {
  Inbox<ControlPad> pads("control/pad");
  ros::NodeHandle nh;
  ros::Publisher chassis = nh.advertise<Chassis>("canbus/chassis", 1, true);
  Chassis in_auto;
  in_auto.driving_mode = Chassis::COMPLETE_AUTO_DRIVE;
  chassis.publish(in_auto);
  blockEveryWorker();
  expectPromptness(ActionCommand::SWITCH_TO_MANUAL, ControlPad::RESET, &pads);
}

TEST_F(Stop, KeepsAPlanFromBeingSentThatEndsAfterIt) {
  Inbox<PlanningCommand> commands("planning/command");
  const auto gate = planner_->holdPlans(false);
  auto planned = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  send(ActionCommand::STOP);
  gate->open();
  const CommandStatus late = planned.get();
  EXPECT_EQ(late.status, CommandStatus::ERROR);
  EXPECT_EQ(late.error_code, CommandStatus::CANCELLED) << late.message;

  // What is commanded after the stop is sent, and is the first that arrives.
  planner_->holdPlans(true)->open();
  const CommandStatus next = plan().get();
  EXPECT_EQ(next.status, CommandStatus::RUNNING) << next.message;
  ASSERT_TRUE(commands.waitFor(1));
  EXPECT_EQ(commands.messages().front().command_id, next.command_id);
}

TEST_F(Stop, CancelsAPlanThatPollsItsToken) {
  const auto gate = planner_->holdPlans(true);
  auto planned = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  send(ActionCommand::STOP);
  EXPECT_TRUE(gate->waitForLeft(1)) << "though nobody opened the gate";
  EXPECT_EQ(planned.get().error_code, CommandStatus::CANCELLED);
}

TEST_F(Stop, LetsANewerCommandCancelAnOlderPlan) {
  Inbox<PlanningCommand> commands("planning/command");
  const auto gate = planner_->holdPlans(true);
  auto older = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  planner_->holdPlans(true)->open();
  const CommandStatus newer = plan().get();
  EXPECT_EQ(older.get().error_code, CommandStatus::SUPERSEDED);
  ASSERT_TRUE(commands.waitFor(1));
  EXPECT_EQ(commands.messages().front().command_id, newer.command_id);
}

TEST_F(Stop, EndsWhatIsStillChecked) {
  planner_->setHoldsChecks(true);
  const auto gate = planner_->holdPlans(true);
  auto checked = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  send(ActionCommand::STOP);
  EXPECT_TRUE(gate->waitForLeft(1)) << "though nobody opened the gate";
  const CommandStatus status = checked.get();
  EXPECT_EQ(status.error_code, CommandStatus::CANCELLED);
  EXPECT_NE(status.message.find("arrived before a stop"), std::string::npos) << status.message;
}

TEST_F(Stop, LetsANewerCommandEndWhatIsStillChecked) {
  planner_->setHoldsChecks(true);
  const auto gate = planner_->holdPlans(true);
  auto checked = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  planner_->setHoldsChecks(false);
  planner_->holdPlans(true)->open();
  EXPECT_EQ(plan().get().status, CommandStatus::RUNNING);
  EXPECT_TRUE(gate->waitForLeft(1)) << "though nobody opened the gate";
  EXPECT_EQ(checked.get().error_code, CommandStatus::SUPERSEDED);
}

TEST_F(Stop, LetsACommandThatIsStillCheckedLeaveAnOlderPlanAlone) {
  const auto gate = planner_->holdPlans(true);
  auto older = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  planner_->setHoldsChecks(true);
  const auto checks = planner_->holdPlans(true);
  auto checked = plan();
  ASSERT_TRUE(checks->waitForEntered(1));
  gate->open();
  EXPECT_EQ(older.get().status, CommandStatus::RUNNING);
  checks->open();
  EXPECT_EQ(checked.get().status, CommandStatus::RUNNING);
}

TEST_F(Stop, ActsAgainUnderTheIdOfAStopThatRuns) {
  Inbox<PlanningPad> pads("planning/pad");
  const std::int64_t id = 7;
  EXPECT_EQ(send(ActionCommand::STOP, id).command_id, id);
  ASSERT_TRUE(pads.waitFor(1));
  const auto gate = planner_->holdPlans(true);
  auto planned = plan(8);
  ASSERT_TRUE(gate->waitForEntered(1));
  const CommandStatus again = send(ActionCommand::STOP, id);
  EXPECT_NE(again.command_id, id);
  EXPECT_NE(again.message.find("command_id 7 belongs to"), std::string::npos) << again.message;
  EXPECT_TRUE(pads.waitFor(2)) << "it is sent again";
  EXPECT_EQ(planned.get().error_code, CommandStatus::CANCELLED);
}

TEST_F(Stop, ActsUnderTheIdOfAMotionCommandThatRuns) {
  Inbox<PlanningPad> pads("planning/pad");
  planner_->holdPlans(true)->open();
  const CommandStatus motion = plan(1).get();
  ASSERT_EQ(motion.status, CommandStatus::RUNNING) << motion.message;
  for (const std::uint8_t action : {ActionCommand::STOP, ActionCommand::CLEAR_PLANNING}) {
    const std::size_t seen = pads.messages().size();
    const CommandStatus status = send(action, 1);
    EXPECT_NE(status.status, CommandStatus::ERROR) << status.message;
    EXPECT_NE(status.command_id, 1);
    EXPECT_TRUE(pads.waitFor(seen + 1));
  }
}

TEST_F(Stop, KeepsWhatWaitsForAThreadFromBeingSent) {
  Inbox<PlanningCommand> commands("planning/command");
  Inbox<CommandStatus> statuses("external_command/status");
  const auto gate = planner_->holdPlans(false);
  std::vector<std::future<CommandStatus>> plans;
  for (unsigned i = 1; i <= 2; ++i) {  // the second is called later: of two at once the older may never begin
    plans.push_back(plan());
    ASSERT_TRUE(gate->waitForEntered(i));
  }
  for (int i = 0; i < 6; ++i) plans.push_back(plan());
  const auto isPlanned = [](const CommandStatus& status) { return status.message == "being planned"; };
  ASSERT_TRUE(statuses.waitFor(8, isPlanned)) << "all have arrived";
  send(ActionCommand::STOP);
  gate->open();
  for (auto& planned : plans) EXPECT_EQ(planned.get().status, CommandStatus::ERROR);
  planner_->holdPlans(true)->open();
  const CommandStatus next = plan().get();
  ASSERT_EQ(next.status, CommandStatus::RUNNING) << next.message;
  ASSERT_TRUE(commands.waitFor(1));
  EXPECT_EQ(commands.messages().front().command_id, next.command_id);
}

TEST_F(Stop, KeepsWhatWaitsInTheLineOfLegacyRequestsFromBeingSent) {
  ASSERT_TRUE(manager_.load("lane_follow", "test/BlockingLaneFollow"));
  ASSERT_TRUE(manager_.load("old_routing_adapter", "external_command/OldRoutingAdapter"));
  Inbox<PlanningCommand> commands("planning/command");
  Inbox<RoutingResponse> responses("routing_response");
  ros::NodeHandle nh;
  ros::Publisher requests = nh.advertise<RoutingRequest>("routing_request", 10);
  ASSERT_TRUE(comesTrue([&] { return requests.getNumSubscribers() > 0; }));
  RoutingRequest request;
  request.waypoint.resize(1);
  request.waypoint[0].pose.x = 10.0;

  const auto gate = lane_follow_->holdPlans(false);
  requests.publish(request);
  ASSERT_TRUE(gate->waitForEntered(1));
  requests.publish(request);  // waits for the answer to the first
  const auto probe = planner_->holdPlans(true);
  auto marker = plan();  // by the same network thread, so the request is in line by now
  ASSERT_TRUE(probe->waitForEntered(1));
  send(ActionCommand::STOP);
  marker.get();
  lane_follow_->holdPlans(true)->open();
  gate->open();
  ASSERT_TRUE(responses.waitFor(2)) << "both are refused";
  for (const RoutingResponse& response : responses.messages()) {
    EXPECT_NE(response.error_code, RoutingResponse::OK) << response.error_message;
  }
  EXPECT_TRUE(commands.messages().empty());
  requests.publish(request);
  EXPECT_TRUE(commands.waitFor(1)) << "what arrives after the stop is sent";
}

TEST_F(Stop, IsNoCaseForAVehicleThatHasDrivenTheFirstOfItsPathMeanwhile) {
  const Localization localization;
  localization.place(*planner_, 0.0);
  const auto gate = planner_->holdPlans(true);
  auto planned = plan();
  ASSERT_TRUE(gate->waitForEntered(1));
  localization.place(*planner_, 4.0);
  gate->open();
  const CommandStatus status = planned.get();
  EXPECT_EQ(status.status, CommandStatus::RUNNING) << status.message << ": it is on its path";
}

TEST_F(Stop, LeavesTheRunningCommandAloneWhereTheVehicleIsElsewhereThanTheNewPath) {
  const Localization localization;
  localization.place(*planner_, 0.0);
  planner_->holdPlans(true)->open();
  const CommandStatus running = plan().get();
  ASSERT_EQ(running.status, CommandStatus::RUNNING) << running.message;
  const auto first_try = planner_->holdPlans(true);
  auto planned = plan();
  ASSERT_TRUE(first_try->waitForEntered(1));
  localization.place(*planner_, 100.0);
  const auto second_try = planner_->holdPlans(true);
  first_try->open();
  ASSERT_TRUE(second_try->waitForEntered(1)) << "it is planned once more";
  localization.place(*planner_, 200.0);
  second_try->open();
  const CommandStatus refused = planned.get();
  EXPECT_EQ(refused.error_code, CommandStatus::PLANNING_TIMEOUT) << refused.message;
  planner_->holdPlans(true)->open();
  const CommandStatus next = plan().get();
  EXPECT_EQ(next.status, CommandStatus::RUNNING) << next.message;
}

TEST_F(Stop, GetsThroughThoughCallbacksOfAnotherProcessorThrow) {
  ASSERT_TRUE(manager_.load("thrower", "test/ThrowingProcessor"));
  ros::NodeHandle nh;
  ros::Publisher messages = nh.advertise<CommandStatus>(ThrowingProcessor::kTopic, 10);
  ASSERT_TRUE(comesTrue([&] { return messages.getNumSubscribers() > 0; }));
  const std::uint64_t caught = caughtExceptions();
  CommandStatus message;
  message.command_id = 1;
  messages.publish(message);
  message.command_id = 2;
  messages.publish(message);
  EXPECT_TRUE(comesTrue([&] { return caughtExceptions() >= caught + 5; })) << "of both subscribers, and of the timer";
  EXPECT_EQ(send(ActionCommand::STOP).status, CommandStatus::RUNNING);
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "stop_test");
  const ros::NodeHandle nh;  // keeps ROS running between the tests
  return RUN_ALL_TESTS();
}
