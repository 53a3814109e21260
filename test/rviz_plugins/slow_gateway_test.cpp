// SPDX-License-Identifier: Apache-2.0
// A panel whose gateway hangs: it goes on, and its STOP gets through.
#include <gtest/gtest.h>
#include <ros/ros.h>

#include <QElapsedTimer>
#include <QTimer>
#include <atomic>
#include <condition_variable>
#include <mutex>

#include "external_command/Action.h"
#include "external_command/LaneFollow.h"
#include "panel_hand.h"

namespace external_command {
namespace {

constexpr int kLongestPause = 1000;  // of the panel, on a busy machine [ms]

/// Keeps calls until it is opened.
class Barrier {
 public:
  void pass() {
    std::unique_lock<std::mutex> lock(mutex_);
    ++waiting_;
    opened_.wait(lock, [this] { return is_open_; });
    --waiting_;
  }
  void open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_open_ = true;
    opened_.notify_all();
  }
  int waiting() const { return waiting_; }

 private:
  std::mutex mutex_;
  std::condition_variable opened_;
  bool is_open_ = false;
  std::atomic<int> waiting_{0};
};

/// Serves actions and lane follow; the barriers that are set hold them up.
class SlowGateway {
 public:
  explicit SlowGateway(const std::string& vehicle) : nh_(vehicle), spinner_(8, &queue_) {
    nh_.setCallbackQueue(&queue_);
    action_ = nh_.advertiseService("external_command/action", &SlowGateway::act, this);
    lane_follow_ = nh_.advertiseService("external_command/lane_follow", &SlowGateway::follow, this);
    spinner_.start();
  }
  ~SlowGateway() {
    for (Barrier* barrier : {&first_stop, &lane_follow}) barrier->open();
    spinner_.stop();
  }

  Barrier first_stop, lane_follow;
  std::atomic<bool> holds_first_stop{false};
  std::atomic<int> stops{0};

 private:
  bool act(Action::Request& request, Action::Response& response) {
    if (request.command.command == ActionCommand::STOP && ++stops == 1 && holds_first_stop) first_stop.pass();
    response.status.command_id = stops;
    response.status.status = CommandStatus::FINISHED;
    response.status.message = "stopped";
    return true;
  }
  bool follow(LaneFollow::Request& /*request*/, LaneFollow::Response& response) {
    lane_follow.pass();
    response.status.command_id = 1000;
    response.status.status = CommandStatus::FINISHED;
    return true;
  }

  ros::CallbackQueue queue_;
  ros::NodeHandle nh_;
  ros::ServiceServer action_, lane_follow_;
  ros::AsyncSpinner spinner_;
};

class SlowGatewayTest : public testing::Test {
 protected:
  SlowGatewayTest() : gateway_("/slow") {
    hand_.widget<QComboBox>("vehicle")->setEditText("/slow");
    QTest::keyClick(hand_.widget<QComboBox>("vehicle"), Qt::Key_Return);
    panel_.show();
  }

  /// Sends `count` lane follow commands, none of which is answered.
  void sendWithoutAnswer(int count) {
    Q_EMIT ToolHub::instance().goalDragged(10.0, 20.0, 0.0);
    for (int i = 0; i < count; ++i) hand_.press("send");
    ASSERT_TRUE(PanelHand::waitUntil([&] { return gateway_.lane_follow.waiting() > 0; }));
  }

  SlowGateway gateway_;
  CommandPanel panel_;
  PanelHand hand_{&panel_};
};

TEST_F(SlowGatewayTest, StopsWhileCallsHang) {
  sendWithoutAnswer(6);
  hand_.press("stop");
  EXPECT_TRUE(hand_.waitForAnswer("STOP")) << hand_.answers();
  EXPECT_EQ(gateway_.stops, 1);
  EXPECT_GT(gateway_.lane_follow.waiting(), 0) << "those still hang";
}

TEST_F(SlowGatewayTest, StopsAgainWhileAStopHangs) {
  ASSERT_TRUE(PanelHand::waitUntil([&] { return panel_.model().gateway().state().is_found; }));
  gateway_.holds_first_stop = true;
  hand_.press("stop");
  ASSERT_TRUE(PanelHand::waitUntil([&] { return gateway_.first_stop.waiting() == 1; }));
  hand_.press("stop");
  EXPECT_TRUE(hand_.waitForAnswer("stopped")) << hand_.answers();
  EXPECT_EQ(gateway_.stops, 2);
  EXPECT_EQ(gateway_.first_stop.waiting(), 1);
}

TEST_F(SlowGatewayTest, StaysAliveWhileCallsHang) {
  QElapsedTimer since_last;
  qint64 longest = 0;
  QTimer pulse;
  QObject::connect(&pulse, &QTimer::timeout, [&] { longest = std::max(longest, since_last.restart()); });
  since_last.start();
  pulse.start(10);
  sendWithoutAnswer(3);
  EXPECT_TRUE(hand_.waitForAnswer("no answer for 5 s; still waiting")) << hand_.answers();
  EXPECT_LT(longest, kLongestPause);
  gateway_.lane_follow.open();
  EXPECT_TRUE(hand_.waitForAnswer("FINISHED")) << hand_.answers();
}

TEST_F(SlowGatewayTest, MayBeClosedWhileCallsHang) {
  auto closed = std::make_unique<CommandPanel>();
  PanelHand hand(closed.get());
  hand.widget<QComboBox>("vehicle")->setEditText("/slow");
  QTest::keyClick(hand.widget<QComboBox>("vehicle"), Qt::Key_Return);
  ToolHub::instance().favour(closed.get());
  Q_EMIT ToolHub::instance().goalDragged(10.0, 20.0, 0.0);
  hand.press("send");
  ASSERT_TRUE(PanelHand::waitUntil([&] { return gateway_.lane_follow.waiting() == 1; }));
  closed.reset();
  gateway_.lane_follow.open();
  ASSERT_TRUE(PanelHand::waitUntil([&] { return gateway_.lane_follow.waiting() == 0; }));
  hand_.press("stop");
  EXPECT_TRUE(hand_.waitForAnswer("stopped")) << "the other panel goes on: " << hand_.answers();
}

TEST(PanelWithoutGateway, SaysSo) {
  CommandPanel panel;
  PanelHand hand(&panel);
  hand.widget<QComboBox>("vehicle")->setEditText("/nobody");
  QTest::keyClick(hand.widget<QComboBox>("vehicle"), Qt::Key_Return);
  EXPECT_TRUE(PanelHand::waitUntil([&] { return hand.text("connection").find("no gateway") != std::string::npos; }));
  hand.press("stop");
  EXPECT_TRUE(hand.waitForAnswer("no answer from /nobody/external_command/action")) << hand.answers();
  hand.press("send");
  EXPECT_TRUE(hand.answersHold("Give the goal")) << hand.answers();
}

TEST(Panel, RefusesNamesThatRosDoesNotTake) {
  CommandPanel panel;
  PanelHand hand(&panel);
  const std::string before = panel.model().gateway().vehicle();
  hand.widget<QComboBox>("vehicle")->setEditText("/no good");
  QTest::keyClick(hand.widget<QComboBox>("vehicle"), Qt::Key_Return);
  EXPECT_TRUE(hand.answersHold("connect")) << hand.answers();
  EXPECT_EQ(panel.model().gateway().vehicle(), before);
}

TEST(Panel, ChoosesTheCommandByKeys) {
  CommandPanel panel;
  panel.show();
  panel.activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&panel));
  for (int i = 0; i < static_cast<int>(kCommandKinds.size()); ++i) {
    QTest::keyClick(&panel, static_cast<Qt::Key>(Qt::Key_F1 + i));
    EXPECT_EQ(static_cast<int>(panel.model().draft().kind), i) << "F" << i + 1;
  }
}

TEST(Panels, KeepTheirVehicleAndCommandInTheConfiguration) {
  rviz::Config config;
  {
    CommandPanel panel;
    PanelHand hand(&panel);
    hand.widget<QComboBox>("vehicle")->setEditText("/second");
    QTest::keyClick(hand.widget<QComboBox>("vehicle"), Qt::Key_Return);
    hand.choose(CommandKind::kZoneCover);
    panel.save(config);
  }
  CommandPanel panel;
  panel.load(config);
  EXPECT_EQ(panel.model().gateway().vehicle(), "/second");
  EXPECT_EQ(PanelHand(&panel).widget<QComboBox>("vehicle")->currentText(), "/second");
  EXPECT_EQ(panel.model().draft().kind, CommandKind::kZoneCover);
}

TEST(Panels, OfSeveralTheOneThatWasUsedLastGetsWhatIsPicked) {
  CommandPanel first, second;
  PanelHand use_first(&first), use_second(&second);
  use_second.press("clear_points");
  Q_EMIT ToolHub::instance().goalDragged(1.0, 2.0, 0.5);
  EXPECT_FALSE(first.model().draft().goal);
  ASSERT_TRUE(second.model().draft().goal);
  EXPECT_DOUBLE_EQ(second.model().draft().goal->y, 2.0);
  use_first.press("clear_points");
  Q_EMIT ToolHub::instance().pointClicked(3.0, 4.0);
  EXPECT_EQ(first.model().draft().points.size(), 1u);
  EXPECT_TRUE(second.model().draft().points.empty());
}

}  // namespace
}  // namespace external_command

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "slow_gateway_test");
  const ros::NodeHandle keeps_ros;
  const QApplication application(argc, argv);
  return RUN_ALL_TESTS();
}
