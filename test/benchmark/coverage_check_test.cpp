// SPDX-License-Identifier: Apache-2.0
#include "../benchmark/coverage_check.h"

#include <gtest/gtest.h>

#include <cmath>

#include "../benchmark/motion.h"

namespace external_command {
namespace benchmark {
namespace {

const Pose2d kStart{5.0, 5.0, 0.0};
constexpr double kRadius = 2.5;  // [m]

Ring box(double x0, double y0, double x1, double y1) { return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}; }

/// 30 m by 20 m, for a sweeper that is 2.6 m long, 1.3 m wide and sweeps 1.6 m.
CoverageCase yard(const std::vector<Ring>& holes = {}) {
  CoverageCase field;
  field.rings = {box(0, 0, 30, 20)};
  field.rings.insert(field.rings.end(), holes.begin(), holes.end());
  field.swath_width = 1.6;
  field.vehicle.wheelbase = 1.6;
  field.vehicle.width = 1.3;
  field.vehicle.front_overhang = field.vehicle.rear_overhang = 0.5;
  field.vehicle.min_turning_radius = kRadius;
  field.start = kStart;
  return field;
}

struct Leg {
  double length;  ///< negative in reverse [m]
  double kappa;
  bool works;
};

/// Points every half metre at most, or only at the ends of the legs.
Path drive(const Pose2d& start, const std::vector<Leg>& legs, double spacing = 0.5) {
  Path path(1);
  path[0].x = start.x, path[0].y = start.y, path[0].heading = start.heading;
  for (const Leg& leg : legs) {
    const Pose2d from = path.back().pose();
    const double pieces = std::ceil(std::abs(leg.length) / spacing);
    for (double piece = 1.0; piece <= pieces; ++piece) {
      const Pose2d pose = along(from, {leg.length, 0.0, leg.length * leg.kappa}, piece / pieces);
      ReferencePoint point;
      point.x = pose.x, point.y = pose.y, point.heading = pose.heading;
      point.direction = leg.length > 0.0 ? Direction::kForward : Direction::kReverse;
      point.tool_on = leg.works;
      path.push_back(point);
    }
  }
  return path;
}

/// Out, round, back, and a little in reverse.
const Path kGood =
    drive(kStart, {{15.0, 0.0, true}, {M_PI * kRadius, 1.0 / kRadius, false}, {15.0, 0.0, true}, {-5.0, 0.0, false}});

Path moved(Path path, std::size_t first, double dx, double dy, double turn) {
  for (std::size_t i = first; i < path.size(); ++i) path[i].x += dx, path[i].y += dy, path[i].heading += turn;
  return path;
}

std::string faultsOf(const CoverageCase& field, const Path& path) {
  std::string faults;
  for (const std::string& fault : checkCoverage(field, path).faults) faults += fault + "; ";
  return faults;
}

TEST(CoverageCheck, MeasuresAPathThatIsFine) {
  const CoverageCheck check = checkCoverage(yard(), kGood);
  EXPECT_EQ(faultsOf(yard(), kGood), "");
  EXPECT_NEAR(check.free_area, 600.0, 0.05);
  EXPECT_NEAR(check.covered_free * 600.0, 2.0 * 15.0 * 1.6, 0.02);
  EXPECT_NEAR(check.overlap, 0.0, 1e-3);
  EXPECT_NEAR(check.length, 35.0 + M_PI * kRadius, 1e-6);
  EXPECT_NEAR(check.length_ratio, check.length / 30.0, 1e-3);
  EXPECT_NEAR(check.reachable_area, 600.0 - (4.0 - M_PI) * 0.8 * 0.8, 0.05);
  EXPECT_EQ(check.turns, 1U);
  EXPECT_EQ(check.gear_changes, 1U);
  EXPECT_EQ(check.outside, 0U);
}

TEST(CoverageCheck, CountsGoingForthAndBackAsOverlap) {
  const CoverageCheck check = checkCoverage(yard(), drive(kStart, {{10.0, 0.0, true}, {-10.0, 0.0, true}}));
  EXPECT_NEAR(check.overlap, 1.0, 1e-3);
  EXPECT_NEAR(check.covered_free * 600.0, 16.0, 0.02);
}

TEST(CoverageCheck, MeasuresARing) {
  const Path ring = drive({15.0, 5.0, 0.0}, {{2.0 * M_PI * 4.0, 0.25, true}});
  EXPECT_NEAR(checkCoverage(yard(), ring).covered_free * 600.0, M_PI * (4.8 * 4.8 - 3.2 * 3.2), 0.1);
}

TEST(CoverageCheck, CountsOnlyWhatIsSweptInside) {
  const CoverageCheck check = checkCoverage(yard(), drive({5.0, 0.7, 0.0}, {{20.0, 0.0, true}}));
  EXPECT_NEAR(check.covered_free * 600.0, 1.5 * 20.0, 0.02);
  EXPECT_EQ(check.outside, 0U);
}

TEST(CoverageCheck, LeavesOutARoomThatIsOutOfReach) {
  CoverageCase rooms = yard();  // the way from one to the other is 1.2 m wide
  rooms.rings[0] = {{0, 0},   {10, 0},  {10, 9},    {20, 9},    {20, 0},  {30, 0},
                    {30, 20}, {20, 20}, {20, 10.2}, {10, 10.2}, {10, 20}, {0, 20}};
  EXPECT_NEAR(checkCoverage(rooms, kGood).reachable_area, 200.0 - (4.0 - M_PI) * 0.8 * 0.8, 0.3);
  rooms.rings[0][8].y() = rooms.rings[0][9].y() = 11.0;  // 2 m
  EXPECT_NEAR(checkCoverage(rooms, kGood).reachable_area, 420.0 - 2.0 * (4.0 - M_PI) * 0.8 * 0.8, 0.3);
}

TEST(CoverageCheck, FindsAFootprintThatIsOutside) {
  const Path straight = drive(kStart, {{20.0, 0.0, true}}, 20.0);
  EXPECT_EQ(checkCoverage(yard(), straight).outside, 0U);
  EXPECT_EQ(checkCoverage(yard({box(14, 5.645, 14.04, 6)}), straight).outside, 0U) << "a hole grazed by 5 mm";
  EXPECT_GT(checkCoverage(yard({box(14, 5.62, 14.04, 6)}), straight).outside, 0U) << "a hole grazed by 30 mm";
  EXPECT_GT(checkCoverage(yard({box(12, 5, 12.05, 5.05)}), straight).outside, 0U) << "a pillar under the vehicle";
  EXPECT_GT(checkCoverage(yard({box(3, 3, 28, 15)}), straight).outside, 100U) << "wholly in a hole";
  EXPECT_GT(checkCoverage(yard(), drive(kStart, {{23.2, 0.0, true}}, 23.2)).outside, 0U) << "leaves by the front";
  EXPECT_EQ(checkCoverage(yard(), drive(kStart, {{22.9, 0.0, true}}, 22.9)).outside, 0U);
  EXPECT_GT(checkCoverage(yard(), moved(straight, 0, 100.0, 0.0, 0.0)).outside, 100U) << "wholly outside";
}

TEST(CoverageCheck, FindsWhatNoVehicleDrives) {
  const auto bent = [](double kappa, double spacing) { return drive(kStart, {{5.0, kappa, true}}, spacing); };
  EXPECT_EQ(faultsOf(yard(), bent(1.0 / kRadius, 0.1)), "");
  EXPECT_NE(faultsOf(yard(), bent(1.06 / kRadius, 0.1)).find("curvature"), std::string::npos);
  EXPECT_NE(faultsOf(yard(), bent(1.06 / kRadius, 5.0)).find("curvature"), std::string::npos);
  EXPECT_NE(faultsOf(yard(), moved(kGood, 20, 0.0, 0.05, 0.0)).find("sideways"), std::string::npos);
  EXPECT_NE(faultsOf(yard(), moved(kGood, 20, 0.0, 0.0, 0.3)).find("turns too much"), std::string::npos);
  Path wrong_gear = kGood;
  wrong_gear[12].direction = Direction::kReverse;
  EXPECT_NE(faultsOf(yard(), wrong_gear).find("against its gear"), std::string::npos);
}

TEST(CoverageCheck, ComparesTheStart) {
  EXPECT_NE(faultsOf(yard(), moved(kGood, 0, 0.2, 0.0, 0.0)).find("from the start"), std::string::npos);
  CoverageCase anywhere = yard();
  anywhere.start.reset();
  EXPECT_EQ(faultsOf(anywhere, moved(kGood, 0, 0.2, 0.0, 0.0)), "");
}

TEST(CoverageCheck, OfNoPathIsAFault) { EXPECT_NE(faultsOf(yard(), {}), ""); }

TEST(CoverageCheck, IsTheSameFarFromTheOrigin) {
  CoverageCase far = yard({box(14, 12, 16, 14)});
  const CoverageCheck here = checkCoverage(far, kGood);
  for (Ring& ring : far.rings) {
    for (Point2d& point : ring) point += Point2d(5e5, 4e6);
  }
  far.start = Pose2d{kStart.x + 5e5, kStart.y + 4e6, kStart.heading};
  const CoverageCheck there = checkCoverage(far, moved(kGood, 0, 5e5, 4e6, 0.0));
  EXPECT_EQ(there.faults, here.faults);
  EXPECT_NEAR(there.covered_reachable, here.covered_reachable, 1e-6);
  EXPECT_NEAR(there.reachable_area, here.reachable_area, 1e-3);
}

}  // namespace
}  // namespace benchmark
}  // namespace external_command
