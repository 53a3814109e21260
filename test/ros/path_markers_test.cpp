// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "external_command/core/polygon.h"
#include "external_command/ros/markers.h"

namespace external_command {
namespace {

constexpr double kSpacing = 0.5;  // [m]

/// `count` points from the origin along x, each turned by `turn` [rad] against the one before.
Path line(std::size_t count, double turn, Direction direction = Direction::kForward) {
  Path path(count);
  for (std::size_t i = 1; i < count; ++i) {
    path[i].heading = path[i - 1].heading + turn;
    const Point2d step = kSpacing * unitVector(path[i - 1].heading + turn / 2.0);
    path[i].x = path[i - 1].x + step.x();
    path[i].y = path[i - 1].y + step.y();
  }
  for (ReferencePoint& point : path) point.direction = direction;
  setArcLengths(&path);
  return path;
}

visualization_msgs::Marker drawn(const Path& path) {
  CommandScene scene;
  scene.path = std::make_shared<const Path>(path);
  for (const auto& marker : commandMarkers(scene, nullptr, VehicleParams(), "map").markers) {
    if (marker.ns == "path") return marker;
  }
  return {};
}

Point2d place(const geometry_msgs::Point& point) { return {point.x, point.y}; }

/// The most that a point of the path lies beside what is drawn of it [m].
double worstDistance(const Path& path, const visualization_msgs::Marker& lines) {
  double worst = 0.0;
  for (const ReferencePoint& point : path) {
    const Point2d at = point.pose().position();
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i + 1 < lines.points.size(); i += 2) {
      const Point2d foot = nearestOnSegment(at, place(lines.points[i]), place(lines.points[i + 1]));
      nearest = std::min(nearest, (foot - at).norm());
    }
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(PathMarkers, DrawALongStraightPathByFewPoints) {
  const auto lines = drawn(line(200000, 0.0));
  EXPECT_LT(lines.points.size(), 25000U);
  EXPECT_EQ(lines.colors.size(), lines.points.size());
  EXPECT_NEAR(lines.points.front().x, 0.0, 1e-9);
  EXPECT_NEAR(lines.points.back().x, 199999 * kSpacing, 1e-6);
}

TEST(PathMarkers, DrawBendsWithinAFewCentimetres) {
  for (const double turn : {0.001, 0.01, 0.05, 0.1}) {
    const Path path = line(500, turn);
    EXPECT_LT(worstDistance(path, drawn(path)), 0.05) << turn;
  }
}

TEST(PathMarkers, ChangeTheColourWhereTheGearChanges) {
  Path path = line(21, 0.0), back = line(21, 0.0, Direction::kReverse);
  for (std::size_t i = 0; i < back.size(); ++i) back[i].x = path.back().x - back[i].x;
  path = join(path, back);
  const auto lines = drawn(path);
  ASSERT_EQ(lines.colors.size(), lines.points.size());
  double ahead = 0.0, back_again = 0.0;  // [m]
  for (std::size_t i = 0; i + 1 < lines.points.size(); i += 2) {
    const bool is_first_colour = lines.colors[i].g == lines.colors.front().g;
    (is_first_colour ? ahead : back_again) += (place(lines.points[i + 1]) - place(lines.points[i])).norm();
  }
  EXPECT_NEAR(ahead, 10.0, 1e-9);
  EXPECT_NEAR(back_again, 10.0, 1e-9);
}

TEST(PathMarkers, OfNoPathAreDeleted) {
  EXPECT_EQ(drawn({}).action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(drawn(line(1, 0.0)).action, visualization_msgs::Marker::DELETE);
  EXPECT_EQ(drawn(line(2, 0.0)).points.size(), 2U);
}

}  // namespace
}  // namespace external_command
