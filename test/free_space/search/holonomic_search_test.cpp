// SPDX-License-Identifier: Apache-2.0
#include "free_space/search/holonomic_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "search_world.h"

namespace external_command {
namespace {

/// Angle that the body turns on the way without driving an arc for it, and what it steps sideways.
struct Shifts {
  double turned = 0.0;    ///< [rad]
  double sideways = 0.0;  ///< [m]
};

Shifts shiftsOf(const std::vector<Pose2d>& way) {
  Shifts shifts;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Point2d moved = way[i].position() - way[i - 1].position();
    const double turn = std::abs(angleBetween(way[i - 1].heading, way[i].heading));
    if (moved.norm() < 1e-9) shifts.turned += turn;
    if (turn < 1e-9) shifts.sideways += std::abs(cross(unitVector(way[i].heading), moved));
  }
  return shifts;
}

void expectsFreeSteps(const std::vector<Pose2d>& way, const SearchWorld& world) {
  ASSERT_GE(way.size(), 2U);
  EXPECT_EQ(way.front().position(), world.query.start.position());
  EXPECT_EQ(way.back().position(), world.query.goal.position());
  for (std::size_t i = 1; i < way.size(); ++i) {
    EXPECT_TRUE(world.index.isFree(way[i]));
    EXPECT_LT((way[i].position() - way[i - 1].position()).norm(), 0.25);
    EXPECT_LT(std::abs(angleBetween(way[i - 1].heading, way[i].heading)), 0.2);
  }
}

std::vector<Pose2d> wayIn(const SearchWorld& world, const std::function<bool()>& stop = kNeverStop) {
  return HolonomicSearch(world.scene, world.query.start, world.query.goal, world.to_goal).way(stop);
}

TEST(HolonomicSearch, TurnsOnTheSpotWhereOnlyThatFits) {
  const SearchWorld world(street(5.3));
  const auto way = wayIn(world);
  expectsFreeSteps(way, world);
  EXPECT_GT(shiftsOf(way).turned, 0.5);
}

TEST(HolonomicSearch, FollowsACorridorRoundItsCorner) {
  const SearchWorld world(corner(3.2));
  expectsFreeSteps(wayIn(world), world);
}

TEST(HolonomicSearch, StepsSidewaysIntoASlot) {
  const SearchWorld world(parallelSlot(0.8));
  const auto way = wayIn(world);
  expectsFreeSteps(way, world);
  EXPECT_GT(shiftsOf(way).sideways, 0.5);
}

TEST(HolonomicSearch, FindsNoWayWhereTheBodyDoesNotFit) {
  EXPECT_TRUE(wayIn(SearchWorld(street(4.8))).empty());
  EXPECT_TRUE(wayIn(SearchWorld(corner(2.2))).empty());
}

TEST(HolonomicSearch, FindsNoWayOnceStopped) {
  EXPECT_TRUE(wayIn(SearchWorld(street(5.3)), [] { return true; }).empty());
}

TEST(HolonomicSearch, ShiftsElsewhereOnceAPlaceIsToBeAvoided) {
  const SearchWorld world(street(5.3));
  HolonomicSearch search(world.scene, world.query.start, world.query.goal, world.to_goal);
  const auto across = [](const std::vector<Pose2d>& way) {
    return *std::min_element(way.begin(), way.end(), [](const Pose2d& a, const Pose2d& b) {
      return std::abs(std::cos(a.heading)) < std::abs(std::cos(b.heading));
    });
  };
  const Pose2d first = across(search.way(kNeverStop));
  search.avoid(first);
  const Pose2d second = across(search.way(kNeverStop));
  EXPECT_GT((second.position() - first.position()).norm() + std::abs(angleBetween(first.heading, second.heading)), 0.1);
}

}  // namespace
}  // namespace external_command
