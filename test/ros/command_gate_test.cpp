// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_gate.h"

#include <gtest/gtest.h>
#include <ros/time.h>

#include <list>
#include <optional>
#include <vector>

namespace external_command {
namespace {

class Gate : public testing::Test {
 protected:
  Gate() { ros::Time::init(); }

  AdmittedCommand arrive(std::int64_t id) { return {++serial_, id, gate_.arrive()}; }
  /// The work on a command, until the end of the test.
  CommandGate::Planning& work(const AdmittedCommand& command, const CancelSource& source = CancelSource(),
                              CommandGate::Planning::Kind kind = CommandGate::Planning::Kind::kMotion) {
    return works_.emplace_back(&gate_, kind, command, source);
  }
  CommandGate::Ticket begin(std::int64_t id) { return gate_.begin(work(arrive(id))); }

  std::shared_ptr<const SentMotion> send(const CommandGate::Ticket& ticket) {
    auto motion = std::make_shared<SentMotion>();
    motion->command = ticket.command();
    motion->path = std::make_shared<const Path>();
    return gate_.commit(ticket, motion, [this] { ++published_; });
  }

  /// Cancels `serial`; the stamp of what the planner is told to clear it, nullopt where it is told nothing.
  std::optional<ros::Time> cancel(CommandSerial serial, bool is_running = true) {
    std::optional<ros::Time> cleared;
    gate_.cancel(
        serial, [&] { return is_running; }, [&](const ros::Time& stamp) { cleared = stamp; });
    return cleared;
  }

  std::int64_t idUnderWay() const { return gate_.motion() ? gate_.motion()->command.id : 0; }

  /// The ids of what is shown, in that order.
  std::vector<std::int64_t> showAll() {
    std::vector<std::int64_t> shown;
    while (const auto motion = gate_.unshown()) gate_.show(*motion, [&] { shown.push_back(motion->command.id); });
    return shown;
  }

  CommandGate gate_;
  std::list<CommandGate::Planning> works_;
  CommandSerial serial_ = 0;
  int published_ = 0;
};

TEST_F(Gate, SendsACommandThatNothingStopped) {
  EXPECT_EQ(send(begin(7)), nullptr);
  EXPECT_EQ(published_, 1);
  EXPECT_EQ(idUnderWay(), 7);
}

TEST_F(Gate, TellsWhichMotionIsReplacedThoughItHasTheSameId) {
  send(begin(7));
  const auto first = gate_.motion()->command.serial;
  const auto replaced = send(begin(7));
  ASSERT_NE(replaced, nullptr);
  EXPECT_EQ(replaced->command.serial, first);
}

TEST_F(Gate, DoesNotSendAPlanThatEndsAfterAStop) {
  const auto ticket = begin(7);
  gate_.stop(true, {});
  EXPECT_TRUE(ticket.cancelToken().isCancelled());
  EXPECT_THROW(send(ticket), Cancelled);
  EXPECT_EQ(published_, 0);
}

TEST_F(Gate, DoesNotBeginARequestThatArrivedBeforeAStop) {
  const auto early = arrive(7);
  gate_.stop(true, {});
  EXPECT_THROW(gate_.requireNewest(early), Cancelled);
  EXPECT_THROW(work(early), Cancelled);
}

TEST_F(Gate, EndsTheWorkOnACommandThatDidNotBeginByAStop) {
  const auto& checked = work(arrive(7));
  gate_.stop(false, {});
  EXPECT_TRUE(checked.cancelToken().isCancelled());
  EXPECT_THROW(gate_.begin(checked), Cancelled);
}

TEST_F(Gate, EndsTheWorkOnACommandThatDidNotBeginWhereALaterOneDoes) {
  const auto& older = work(arrive(7));
  const auto& newer = work(arrive(8));
  const auto& newest = work(arrive(9));
  gate_.begin(newer);
  EXPECT_TRUE(older.cancelToken().isCancelled());
  EXPECT_THROW(gate_.begin(older), Superseded);
  EXPECT_FALSE(newest.cancelToken().isCancelled());
}

TEST_F(Gate, EndsTheWorkOnADryRunByItsCancellingOnly) {
  const auto early = arrive(7);
  gate_.stop(true, {});
  const auto& dry = work(early, CancelSource(), CommandGate::Planning::Kind::kDryRun);
  begin(8);
  gate_.stop(true, {});
  EXPECT_FALSE(dry.cancelToken().isCancelled());
  cancel(dry.command().serial);
  EXPECT_TRUE(dry.cancelToken().isCancelled());
}

TEST_F(Gate, LeavesOtherWorkAloneWhereOneIsCancelled) {
  const auto& one = work(arrive(7));
  const auto& other = work(arrive(7));
  cancel(other.command().serial);
  EXPECT_FALSE(one.cancelToken().isCancelled());
  EXPECT_TRUE(other.cancelToken().isCancelled());
}

TEST_F(Gate, ForgetsWorkThatHasEnded) {
  const CancelSource source;
  { const CommandGate::Planning ended(&gate_, CommandGate::Planning::Kind::kMotion, arrive(7), source); }
  gate_.stop(true, {});
  EXPECT_FALSE(source.token().isCancelled());
}

TEST_F(Gate, SendsWhatMovesNothingUnlessItArrivedBeforeAStop) {
  const auto early = arrive(7);
  begin(8);
  EXPECT_NO_THROW(gate_.sendUnlessStopped(early, [this] { ++published_; })) << "a later motion does not matter";
  gate_.stop(false, {});
  EXPECT_THROW(gate_.sendUnlessStopped(early, [this] { ++published_; }), Cancelled);
  EXPECT_NO_THROW(gate_.sendUnlessStopped(arrive(9), [this] { ++published_; }));
  EXPECT_EQ(published_, 2);
}

TEST_F(Gate, SendsARequestThatArrivedAfterAStop) {
  gate_.stop(true, {});
  EXPECT_NO_THROW(send(begin(7)));
  EXPECT_EQ(published_, 1);
}

TEST_F(Gate, CancelsAnOlderPlanningWhenANewerBegins) {
  const auto older = begin(7);
  const auto newer = begin(8);
  EXPECT_TRUE(older.cancelToken().isCancelled());
  EXPECT_FALSE(newer.cancelToken().isCancelled());
  EXPECT_THROW(send(older), Superseded);
  EXPECT_NO_THROW(send(newer));
  EXPECT_EQ(published_, 1);
}

TEST_F(Gate, CountsTheLaterArrivalAsTheNewerHoweverLongEachTakesToBegin) {
  const auto slow = arrive(7);
  const auto quick = begin(8);
  EXPECT_THROW(work(slow), Superseded);
  EXPECT_FALSE(quick.cancelToken().isCancelled());
  EXPECT_NO_THROW(send(quick));
}

TEST_F(Gate, LetsACommandBeginOnceMoreWithoutCancellingItself) {
  const auto& planning = work(arrive(7));
  gate_.begin(planning);
  const auto again = gate_.begin(planning);
  EXPECT_FALSE(again.cancelToken().isCancelled());
  EXPECT_NO_THROW(send(again));
}

TEST_F(Gate, TellsAStopWhichMotionIsUnderWay) {
  EXPECT_EQ(gate_.stop(true, {}), nullptr);
  send(begin(7));
  ASSERT_NE(gate_.stop(true, {}), nullptr);
  EXPECT_EQ(idUnderWay(), 7) << "a stop holds it, and does not end it";
}

TEST_F(Gate, RetiresAMotionButNotTheOneAfterIt) {
  send(begin(7));
  const auto first = gate_.motion()->command.serial;
  send(begin(7));
  gate_.retire(first);
  EXPECT_EQ(idUnderWay(), 7) << "the second by that id";
  gate_.retire(gate_.motion()->command.serial);
  EXPECT_EQ(gate_.motion(), nullptr);
}

TEST_F(Gate, ClearsTheMotionUnderWayThatIsCancelled) {
  send(begin(7));
  EXPECT_TRUE(cancel(gate_.motion()->command.serial));
  EXPECT_EQ(gate_.motion(), nullptr);
}

TEST_F(Gate, ClearsNothingForACommandThatIsNotUnderWay) {
  send(begin(7));
  const auto first = gate_.motion()->command.serial;
  EXPECT_FALSE(cancel(first, false)) << "it has ended already";
  EXPECT_EQ(idUnderWay(), 7);
  send(begin(7));
  EXPECT_FALSE(cancel(first)) << "another took its place, by the same id";
  EXPECT_EQ(idUnderWay(), 7);
}

TEST_F(Gate, NeitherBeginsNorSendsACommandWhosePlanningIsCancelled) {
  const CancelSource planning;
  const auto ticket = gate_.begin(work(arrive(7), planning));
  planning.cancel();
  EXPECT_THROW(send(ticket), Cancelled);
  EXPECT_EQ(published_, 0);
  const auto older = begin(8);
  EXPECT_THROW(gate_.begin(work(arrive(9), planning)), Cancelled);
  EXPECT_FALSE(older.cancelToken().isCancelled()) << "what did not begin cancels nothing";
  EXPECT_NO_THROW(send(older));
}

TEST_F(Gate, LetsAMotionThatIsPlannedMeanwhileGoOnWhenTheOneUnderWayIsCancelled) {
  send(begin(7));
  const auto newer = begin(8);
  const ros::Time stamp_of_newer = ros::Time::now();  // a motion is stamped when it is planned, before it is sent
  const auto cleared = cancel(gate_.motion()->command.serial);
  ASSERT_TRUE(cleared);
  EXPECT_LE(*cleared, stamp_of_newer) << "a planner would take the newer motion for cleared, too";
  EXPECT_FALSE(newer.cancelToken().isCancelled());
  EXPECT_NO_THROW(send(newer));
  EXPECT_EQ(idUnderWay(), 8);
}

TEST_F(Gate, KnowsByTheTimeOfDayWhetherItWasStopped) {
  const ros::WallTime before = ros::WallTime::now();
  EXPECT_FALSE(gate_.wasStoppedSince(before));
  gate_.stop(true, {});
  EXPECT_TRUE(gate_.wasStoppedSince(before));
  EXPECT_FALSE(gate_.wasStoppedSince(ros::WallTime::now() + ros::WallDuration(1.0)));
}

TEST_F(Gate, ShowsWhatWasSentOnceAndInOrder) {
  send(begin(7));
  send(begin(8));
  EXPECT_EQ(showAll(), (std::vector<std::int64_t>{7, 8}));
  EXPECT_TRUE(showAll().empty());
}

TEST_F(Gate, ShowsTheNewestWhereManyWereSentMeanwhile) {
  for (std::int64_t id = 1; id <= 100; ++id) send(begin(id));
  const std::vector<std::int64_t> shown = showAll();
  EXPECT_EQ(shown.size(), 16u);
  EXPECT_EQ(shown.back(), 100);
}

TEST_F(Gate, ShowsNothingBehindAStopOfWhatWasSentBeforeIt) {
  send(begin(7));
  send(begin(8));
  gate_.stop(true, {});
  EXPECT_TRUE(showAll().empty());
}

TEST_F(Gate, ShowsNothingOfAMotionThatHasEnded) {
  send(begin(7));
  gate_.retire(gate_.motion()->command.serial);
  EXPECT_TRUE(showAll().empty());
  send(begin(8));
  cancel(gate_.motion()->command.serial);
  EXPECT_TRUE(showAll().empty());
}

TEST_F(Gate, DoesNotShowWhatAStopOvertook) {
  send(begin(7));
  const auto motion = gate_.unshown();
  gate_.stop(true, {});
  gate_.show(*motion, [] { FAIL() << "it is withdrawn"; });
}

TEST_F(Gate, ShowsWhatIsSentAfterAStop) {
  send(begin(7));
  gate_.stop(true, {});
  send(begin(8));
  EXPECT_EQ(showAll(), (std::vector<std::int64_t>{8}));
}

TEST_F(Gate, ShowsAMotionThatGoesOnWhenThePlanningIsStopped) {
  send(begin(7));
  gate_.stop(false, {});
  EXPECT_EQ(showAll(), (std::vector<std::int64_t>{7}));
}

TEST_F(Gate, PublishesTheStopItself) {
  gate_.stop(true, [this] { ++published_; });
  EXPECT_EQ(published_, 1);
}

}  // namespace
}  // namespace external_command
