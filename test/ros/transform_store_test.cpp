// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/transform_store.h"

#include <gtest/gtest.h>
#include <tf2/exceptions.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>

namespace external_command {
namespace {

constexpr double kMaxFuture = 0.5;

geometry_msgs::TransformStamped edgeOf(const std::string& parent, const std::string& child, double x, ros::Time stamp) {
  geometry_msgs::TransformStamped result;
  result.header.frame_id = parent;
  result.header.stamp = stamp;
  result.child_frame_id = child;
  result.transform.translation.x = x;
  result.transform.rotation.w = 1.0;
  return result;
}

/// Transforms that come at the same rate on both clocks.
class TransformStoreTest : public ::testing::Test {
 protected:
  std::string move(const std::string& parent, const std::string& child, double x) {
    return store_.add(edgeOf(parent, child, x, now_), false, now_, arrival_);
  }
  std::string fix(const std::string& parent, const std::string& child, double x, ros::Time stamp = ros::Time()) {
    return store_.add(edgeOf(parent, child, x, stamp), true, now_, arrival_);
  }
  std::string take(const geometry_msgs::TransformStamped& given) { return store_.add(given, false, now_, arrival_); }

  void wait(double duration) {
    now_ += ros::Duration(duration);
    arrival_ += duration;
    store_.tidy(now_, arrival_);
  }

  /// As a localization does that publishes ten times a second.
  void drive(double duration) {
    for (double end = arrival_ + duration; arrival_ < end; wait(0.1)) {
      move("map", "odom", 0.0);
      move("odom", "base_link", ++x_);
    }
    move("map", "odom", 0.0);
    move("odom", "base_link", ++x_);
  }

  double x() const { return store_.lookup("map", "base_link").transform.translation.x; }

  bool isKnown() const {
    try {
      x();
      return true;
    } catch (const tf2::TransformException&) {
      return false;
    }
  }

  TransformStore store_{kMaxFuture};
  ros::Time now_{1700000000.0};
  double arrival_ = 1000.0;
  double x_ = 0.0;
};

TEST_F(TransformStoreTest, FollowsAChainOfFixedAndMovingFrames) {
  drive(1.0);
  EXPECT_DOUBLE_EQ(x(), x_);
  EXPECT_EQ(fix("/base_link", "/lidar", 2.0), "");
  drive(0.2);
  EXPECT_DOUBLE_EQ(store_.lookup("map", "lidar").transform.translation.x, x_ + 2.0);
}

TEST_F(TransformStoreTest, RefusesWhatIsFurtherInTheFutureThanAllowed) {
  drive(0.2);
  for (const ros::Time stamp : {ros::Time(4294967295U, 999999999U), now_ + ros::Duration(kMaxFuture + 0.01)}) {
    EXPECT_NE(take(edgeOf("odom", "base_link", 1e6, stamp)).find("max_future_stamp"), std::string::npos);
  }
  EXPECT_DOUBLE_EQ(x(), x_);
  EXPECT_EQ(take(edgeOf("odom", "base_link", 7.0, now_ + ros::Duration(kMaxFuture - 0.01))), "");
  drive(0.6);
  EXPECT_DOUBLE_EQ(x(), x_) << "one of the future that is taken does not hide those that come later";
}

TEST_F(TransformStoreTest, TakesAnyStampOfAFixedFrame) {
  drive(0.2);
  EXPECT_EQ(fix("base_link", "lidar", 2.0, ros::Time(4294967295U, 0U)), "");
  drive(0.2);
  EXPECT_DOUBLE_EQ(store_.lookup("map", "lidar").transform.translation.x, x_ + 2.0);
}

TEST_F(TransformStoreTest, RefusesWhatIsNoTransform) {
  drive(0.2);
  auto bad = edgeOf("odom", "base_link", std::numeric_limits<double>::quiet_NaN(), now_);
  EXPECT_NE(take(bad), "");
  bad = edgeOf("odom", "base_link", 1e300, now_);
  EXPECT_NE(take(bad), "");
  bad = edgeOf("odom", "base_link", 5.0, now_);
  for (const double w : {0.0, 0.5, std::numeric_limits<double>::quiet_NaN(), 1e200}) {
    bad.transform.rotation.w = w;
    EXPECT_NE(take(bad), "") << w;
  }
  for (const char* frame : {"", "/", "base_link"}) EXPECT_NE(move(frame, "base_link", 5.0), "") << frame;
  EXPECT_NE(move("odom", "", 5.0), "");
  EXPECT_NE(move("odom", std::string(100000, 'x'), 5.0), "");
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, KeepsWhatIsOlderThanKnownOut) {
  drive(0.2);
  EXPECT_EQ(take(edgeOf("odom", "base_link", -5.0, now_ - ros::Duration(0.05))), "");
  EXPECT_NE(take(edgeOf("odom", "base_link", -5.0, ros::Time())), "") << "without a stamp, beside others with one";
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, TakesAPublisherThatGivesNoStamps) {
  EXPECT_EQ(take(edgeOf("map", "base_link", 1.0, ros::Time())), "");
  wait(0.1);
  EXPECT_EQ(take(edgeOf("map", "base_link", 2.0, ros::Time())), "");
  EXPECT_DOUBLE_EQ(x(), 2.0);
  EXPECT_EQ(store_.lookup("map", "base_link").header.stamp, now_) << "it grows old like any other";
}

TEST_F(TransformStoreTest, KeepsLoopsOut) {
  drive(0.2);
  EXPECT_NE(move("base_link", "map", 1.0), "");
  EXPECT_NE(move("base_link", "odom", 1.0), "");
  EXPECT_NE(fix("base_link", "map", 1.0), "");
  drive(0.1);
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, IsFreeOfALoopAsSoonAsThePublishersOfTheTreeAreBack) {
  EXPECT_EQ(move("base_link", "map", 1.0), "");
  drive(0.5);
  wait(TransformStore::kFresh);
  drive(0.2);
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, LetsARegularPublisherOpenALoopOfFixedFrames) {
  EXPECT_EQ(fix("base_link", "map", 1.0), "");
  drive(0.5);
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, KeepsAMovingFrameMovingAndLetsItBeFixedWhereItHasStopped) {
  drive(0.2);
  EXPECT_NE(fix("map", "odom", 100.0, now_ + ros::Duration(1e9)), "");
  drive(0.2);
  EXPECT_DOUBLE_EQ(x(), x_);
  wait(TransformStore::kFresh + 0.1);
  wait(0.1);
  move("odom", "base_link", 1.0);
  EXPECT_DOUBLE_EQ(x(), 101.0) << "the latched transform that came while the frame was moving";
}

TEST_F(TransformStoreTest, DoesNotFallBackOnAFixedTransformThatAMovingFrameHasOutlived) {
  drive(0.2);
  fix("map", "odom", 100.0);
  drive(TransformStore::kHandover + 1.0);
  const double last = x_;
  wait(TransformStore::kFresh + 0.1);
  wait(0.1);
  EXPECT_DOUBLE_EQ(x(), last) << "the vehicle's last pose, growing old";
}

TEST_F(TransformStoreTest, LetsAFixedFrameMoveWhereThatComesAgainAndAgain) {
  EXPECT_EQ(fix("map", "base_link", 50.0), "");
  EXPECT_NE(move("map", "base_link", 1.0), "");
  EXPECT_DOUBLE_EQ(x(), 50.0);
  for (int i = 0; i < TransformStore::kInsists; ++i, wait(0.1)) move("map", "base_link", 2.0);
  EXPECT_DOUBLE_EQ(x(), 2.0);
  EXPECT_FALSE(store_.lookup("map", "base_link").header.stamp.isZero()) << "and it grows old";
}

TEST_F(TransformStoreTest, ForgetsWhatIsOfTheFutureWhereTimeJumpsBack) {
  fix("base_link", "lidar", 2.0);
  drive(1.0);
  now_ -= ros::Duration(1000.0);
  EXPECT_EQ(take(edgeOf("map", "odom", 0.0, now_)), "");
  EXPECT_FALSE(isKnown());
  drive(0.2);
  EXPECT_DOUBLE_EQ(x(), x_);
  EXPECT_DOUBLE_EQ(store_.lookup("map", "lidar").transform.translation.x, x_ + 2.0);
}

TEST_F(TransformStoreTest, HasRoomForGoodFramesAfterAFloodOfOthers) {
  for (std::size_t i = 0; i < 2 * TransformStore::kMaxFrames; ++i) move("nowhere", "frame_" + std::to_string(i), 1.0);
  EXPECT_LE(store_.frames(), TransformStore::kMaxFrames);
  wait(TransformStore::kFresh + 0.1);
  drive(0.2);
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, RefusesAChainWithoutEnd) {
  for (int i = 5000; i > 0; --i) move("link_" + std::to_string(i - 1), "link_" + std::to_string(i), 1.0);
  EXPECT_NE(move("link_5000", "link_5001", 1.0).find("deeper"), std::string::npos);
  EXPECT_THROW(store_.lookup("link_0", "link_5000"), tf2::TransformException);
  drive(0.2);
  EXPECT_DOUBLE_EQ(x(), x_);
}

TEST_F(TransformStoreTest, TellsWhatTheVehicleCarriesFromWhatItDrivesBy) {
  const auto is_carried = [this](const std::string& frame) { return store_.isCarried(frame, "base_link", "map"); };
  fix("map", "dock", 5.0);
  fix("base_link", "lidar", 1.0);
  move("lidar", "beam", 1.0);
  EXPECT_TRUE(is_carried("lidar"));
  drive(0.2);
  move("lidar", "beam", 1.0);
  for (const char* frame : {"base_link", "lidar", "beam"}) EXPECT_TRUE(is_carried(frame)) << frame;
  for (const char* frame : {"map", "odom", "dock", "never seen", ""}) EXPECT_FALSE(is_carried(frame)) << frame;
}

TEST_F(TransformStoreTest, TellsThatTheVehicleCarriesTheAntennaByWhichItIsLocated) {
  move("map", "antenna", 1.0);
  fix("antenna", "base_link", -1.0);
  fix("map", "dock", 5.0);
  EXPECT_TRUE(store_.isCarried("antenna", "base_link", "map"));
  EXPECT_FALSE(store_.isCarried("dock", "base_link", "map"));
}

TEST_F(TransformStoreTest, TellsWhatTheVehicleCarriesWhereTheMapLiesBelowIt) {
  move("base_link", "map", 1.0);
  fix("map", "dock", 5.0);
  fix("base_link", "lidar", 1.0);
  EXPECT_TRUE(store_.isCarried("lidar", "base_link", "map"));
  EXPECT_FALSE(store_.isCarried("dock", "base_link", "map"));
}

TEST_F(TransformStoreTest, RecoversFromAnyTransformsWithinASecond) {
  std::mt19937 random(1);
  const auto choose = [&](int count) { return std::uniform_int_distribution<int>(0, count - 1)(random); };
  const std::string frames[] = {"map", "odom", "base_link", "lidar", "/map", "", "earth", "base_footprint"};
  for (int round = 0; round < 300; ++round) {
    for (int i = choose(8); i >= 0; --i) {
      auto any = edgeOf(frames[choose(8)], frames[choose(8)], choose(100),
                        choose(4) == 0 ? ros::Time(static_cast<std::uint32_t>(random()), 0U)
                                       : now_ + ros::Duration(0.1 * (choose(20) - 10)));
      if (choose(4) == 0) any.transform.rotation.w = choose(3) - 1;
      // What is fixed stays, and may rightly take a frame that nobody moves; here it never takes one of the tree.
      const bool is_static = choose(4) == 0 && any.child_frame_id == "lidar";
      store_.add(any, is_static, now_, arrival_);
    }
    drive(TransformStore::kFresh + 0.3);
    ASSERT_TRUE(isKnown()) << "round " << round;
    ASSERT_DOUBLE_EQ(x(), x_) << "round " << round;
  }
}

}  // namespace
}  // namespace external_command
