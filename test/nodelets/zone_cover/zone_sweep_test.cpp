// SPDX-License-Identifier: Apache-2.0
#include "nodelets/zone_cover/zone_sweep.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "external_command/core/error.h"
#include "support/zone_plans.h"

namespace external_command {
namespace {

/// The lap and the two swaths, joined by straight jumps, a point per half metre.
class ZoneSweepTest : public testing::Test {
 protected:
  ZoneSweepTest() {
    task_.progress = lapAndSwaths();
    for (std::size_t i = 0; i < task_.progress.lines.size(); ++i) add(i, 0.0);
    task_.goal_area = 400.0;
  }

  /// Line `index` from `from` [m] on; a square metre per metre.
  void add(std::size_t index, double from) {
    const SwathLine& line = task_.progress.lines[index];
    const Path whole = sampleArcs(line.start, line.arcs, 0.5);
    Swath swath;
    swath.index = index;
    swath.first = path_.size();
    swath.from = from;
    for (const ReferencePoint& point : whole) {
      if (point.s < from) continue;
      path_.push_back(point);
      swath.covered.push_back(point.s - from);
    }
    swath.last = path_.size() - 1;
    swath.length = whole.back().s - from;
    swath.covered_area = swath.length;
    task_.swaths.push_back(swath);
    setArcLengths(&path_);
  }

  ZoneSweep begin() const { return ZoneSweep(task_, std::make_shared<Path>(path_)); }

  /// Drives from swath to swath by position, up to `length` [m] of the last one.
  void drive(ZoneSweep* sweep, std::size_t last, double length) const {
    for (std::size_t i = 0; i < path_.size(); ++i) {
      const Swath& swath = task_.swaths[last];
      if (i > swath.first && path_[i].s - path_[swath.first].s > length) return;
      sweep->follow(path_[i].pose());
    }
  }

  ZoneTask task_;
  Path path_;
};

TEST_F(ZoneSweepTest, TellsHowFarItHasCome) {
  ZoneSweep sweep = begin();
  EXPECT_EQ(sweep.words(), "swath 1 of 3, 0 % covered (lap 1 of 1)");
  drive(&sweep, 0, 50.0);
  EXPECT_EQ(sweep.words(), "swath 1 of 3, 12 % covered (lap 1 of 1)");
  drive(&sweep, 2, 10.0);
  EXPECT_EQ(sweep.words(), "swath 3 of 3, 34 % covered");
  sweep.finish();
  EXPECT_EQ(sweep.words(), "swath 3 of 3, 36 % covered");
}

TEST_F(ZoneSweepTest, KeepsHowFarEachLineIsSwept) {
  ZoneSweep sweep = begin();
  drive(&sweep, 0, 50.0);
  EXPECT_NEAR(sweep.progress().sweptOf(0), 50.0, 0.6);
  EXPECT_LE(sweep.progress().sweptOf(0), 50.0 + 1e-9);
  EXPECT_EQ(sweep.progress().countDone(), 0u);
  drive(&sweep, 1, 12.0);
  EXPECT_TRUE(sweep.progress().isDone(0));
  EXPECT_NEAR(sweep.progress().sweptOf(1), 12.0, 0.6);
  EXPECT_EQ(sweep.progress().sweptOf(2), 0.0);
  EXPECT_TRUE(sweep.finish());
  EXPECT_EQ(sweep.progress().countDone(), 3u);
  EXPECT_FALSE(sweep.finish()) << "no news";
}

TEST_F(ZoneSweepTest, DoesNotCountALapAsSweptWhereItBegins) {
  ZoneSweep sweep = begin();
  sweep.follow(path_.front().pose());
  EXPECT_EQ(sweep.progress().sweptOf(0), 0.0);
}

TEST_F(ZoneSweepTest, CountsNothingBeforeThePointIsPassed) {
  ZoneSweep sweep = begin();
  drive(&sweep, 0, 10.0);
  const double before = sweep.progress().sweptOf(0);
  sweep.follow(advance(path_.front().pose(), ArcSegment{10.3, 0.0}));
  EXPECT_EQ(sweep.progress().sweptOf(0), before);
}

TEST_F(ZoneSweepTest, IsNotMovedByAPoseFarAway) {
  ZoneSweep sweep = begin();
  drive(&sweep, 0, 10.0);
  const double before = sweep.progress().sweptOf(0);
  EXPECT_FALSE(sweep.follow({100.0, 100.0, 0.0}));
  EXPECT_FALSE(sweep.follow(Pose2d{path_[20].x, path_[20].y, path_[20].heading + M_PI}));
  EXPECT_EQ(sweep.progress().sweptOf(0), before);
}

TEST_F(ZoneSweepTest, FollowsAVehicleThatIsSeldomSeen) {
  ZoneSweep sweep = begin();
  for (std::size_t i = 0; path_[i].s < 90.0; i += 50) sweep.follow(path_[i].pose());
  EXPECT_NEAR(sweep.progress().sweptOf(0), 75.0, 15.0);
}

TEST_F(ZoneSweepTest, DoesNotCountWhatTheVehicleDroveRound) {
  ZoneSweep sweep = begin();
  drive(&sweep, 0, 5.0);
  sweep.follow({path_[20].x, path_[20].y + 10.0, 0.0});
  sweep.follow(path_[50].pose());
  EXPECT_LT(sweep.progress().sweptOf(0), 6.0);
}

TEST_F(ZoneSweepTest, GoesOnWithARest) {
  task_.progress.sweep(0, 60.0);
  task_.swaths.clear();
  path_.clear();
  add(0, 58.0);
  task_.covered_before = 60.0;
  ZoneSweep sweep = begin();
  EXPECT_EQ(sweep.words(), "swath 1 of 3, 15 % covered (lap 1 of 1)");
  drive(&sweep, 0, 1.0);
  EXPECT_EQ(sweep.progress().sweptOf(0), 60.0) << "what is swept stays swept";
  drive(&sweep, 0, 10.0);
  EXPECT_NEAR(sweep.progress().sweptOf(0), 68.0, 0.6);
}

TEST_F(ZoneSweepTest, TakesOverWhatAnEarlierRunSweptMeanwhile) {
  ZoneSweep sweep = begin();
  CoverageProgress earlier = lapAndSwaths();
  EXPECT_FALSE(sweep.takeOver(earlier));
  earlier.sweep(0, 5.0);
  EXPECT_TRUE(sweep.takeOver(earlier));
  EXPECT_EQ(sweep.progress().sweptOf(0), 5.0);
}

TEST_F(ZoneSweepTest, StandsOnAPathThatGotAStretchInFront) {
  path_.insert(path_.begin(), 5, path_.front());
  shiftPoints(5, &task_);
  ZoneSweep sweep = begin();
  EXPECT_EQ(task_.swaths.front().first, 5u);
  drive(&sweep, 0, 50.0);
  EXPECT_NEAR(sweep.progress().sweptOf(0), 50.0, 0.6);
}

TEST_F(ZoneSweepTest, StandsOnAPathOfWhichTheVehicleHasDrivenTheFirst) {
  path_.erase(path_.begin(), path_.begin() + 20);  // 10 m
  setArcLengths(&path_);
  shiftPoints(-20, &task_);
  EXPECT_EQ(task_.swaths.front().first, 0u);
  EXPECT_NEAR(task_.swaths.front().from, 10.0, 0.1);
  EXPECT_NEAR(task_.swaths.front().covered.back(), task_.swaths.front().length, 0.1);
  ZoneSweep sweep = begin();
  drive(&sweep, 0, 40.0);
  EXPECT_NEAR(sweep.progress().sweptOf(0), 50.0, 0.6);
  drive(&sweep, 1, 5.0);
  EXPECT_TRUE(sweep.progress().isDone(0));
}

/// A stretch of the path, as a vehicle that sweeps on while the next plan is made drives it.
class SweepOnTheWay : public ZoneSweepTest {
 protected:
  static constexpr std::size_t kFirst = 20, kLast = 60;  // 10 m to 30 m of the lap

  Path stretch() const { return Path(path_.begin() + kFirst, path_.begin() + kLast + 1); }

  /// The rest of the lap, planned from the end of the stretch.
  ZoneTask rest() const {
    ZoneTask rest{task_.progress, {task_.swaths.front()}, 30.0, task_.goal_area};
    shiftPoints(-static_cast<std::ptrdiff_t>(kLast), &rest);
    return rest;
  }
};

TEST_F(SweepOnTheWay, IsKnownBeforehand) {
  const std::vector<Swath> swaths = begin().swathsOn(stretch());
  ASSERT_EQ(swaths.size(), 1u);
  EXPECT_EQ(swaths.front().index, 0u);
  EXPECT_EQ(swaths.front().first, 0u);
  EXPECT_EQ(swaths.front().last, kLast - kFirst);
  EXPECT_NEAR(swaths.front().from, 10.0, 0.1);
  EXPECT_NEAR(swaths.front().length, 20.0, 0.1);
  EXPECT_NEAR(swaths.front().covered_area, 20.0, 0.5);
  EXPECT_EQ(swaths.front().covered.size(), kLast - kFirst + 1);
}

TEST_F(SweepOnTheWay, IsNoneOnAPathThatIsNotDriven) {
  EXPECT_TRUE(begin().swathsOn({}).empty());
  Path other = stretch();
  other.front().y += 1.0;
  EXPECT_TRUE(begin().swathsOn(other).empty());
  other = stretch();
  other.pop_back();
  other.back().s += 0.1;
  EXPECT_TRUE(begin().swathsOn(other).empty());
}

TEST_F(SweepOnTheWay, CountsOnlyOnceItIsDriven) {
  for (const std::size_t driven_meanwhile : {std::size_t{0}, std::size_t{10}}) {
    ZoneTask task = rest();
    task.progress.sweep(0, 10.0);
    putInFront(begin().swathsOn(stretch()), stretch(), &task);
    const auto in_front = static_cast<std::ptrdiff_t>(kLast - kFirst - driven_meanwhile);
    shiftPoints(in_front, &task);
    Path path(path_.begin() + kFirst + static_cast<std::ptrdiff_t>(driven_meanwhile), path_.end());
    setArcLengths(&path);
    ZoneSweep sweep(task, std::make_shared<Path>(path));
    EXPECT_EQ(sweep.progress().sweptOf(0), 10.0) << "a vehicle that stops here has swept no more";
    EXPECT_NE(sweep.words().find(", 2 % covered"), std::string::npos) << sweep.words();
    for (const double expected : {25.0, 40.0}) {
      for (const ReferencePoint& point : path_) {
        if (point.s <= expected) sweep.follow(point.pose());
      }
      EXPECT_NEAR(sweep.progress().sweptOf(0), expected, 0.6);
    }
  }
}

TEST_F(ZoneSweepTest, RefusesSwathsThatAreNotOnThePath) {
  shiftPoints(1, &task_);
  EXPECT_THROW(begin(), InternalError);
  shiftPoints(-100000, &task_);
  EXPECT_THROW(begin(), InternalError) << "no swath is left";
}

}  // namespace
}  // namespace external_command
