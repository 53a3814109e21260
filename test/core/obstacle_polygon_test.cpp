// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/obstacle_polygon.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"

namespace external_command {
namespace {

using Points = std::vector<Point2d>;

TEST(ObstaclePolygon, TakesAPointOrALineAsASmallObstacle) {
  for (const Points& points : {Points{{5, 3}}, Points{{5, 3}, {5, 3}, {5, 3}}, Points{{5, 3}, {8, 7}, {6.5, 5}},
                               Points{{5, 3}, {5.002, 3}, {5, 3.002}}, Points{{5, 3}, {9, 3}, {9, 3.0005}, {5, 3.0005}},
                               Points{{1e7, -4e6}, {1e7 + 3, -4e6}, {1e7 - 2, -4e6}}}) {
    const Polygon obstacle = obstaclePolygon(points, "roi");
    for (const Point2d& point : points) {
      EXPECT_TRUE(obstacle.contains(point));
      EXPECT_NEAR(obstacle.distanceToBorder(point), 0.01, 3e-3);
    }
    EXPECT_LT(obstacle.area(), 0.2);
  }
}

TEST(ObstaclePolygon, LeavesOthersAsTheyAre) {
  const Points square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  EXPECT_EQ(obstaclePolygon(square, "roi").points(), Polygon(square, "roi").points());
  EXPECT_EQ(obstaclePolygon({{0, 0}, {0.02, 0}, {0.02, 0.02}}, "roi").points().size(), 3u);
  EXPECT_THROW(obstaclePolygon({}, "roi"), InvalidRequest);
  EXPECT_THROW(obstaclePolygon({{0, 0}, {0, std::nan("")}}, "roi"), InvalidRequest);
  EXPECT_THROW(obstaclePolygon({{0, 0}, {10, 10}, {10, 0}, {0, 10}}, "roi"), InvalidRequest);
}

}  // namespace
}  // namespace external_command
