// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/text.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(Text, PutsItsArgumentsOneAfterTheOther) {
  EXPECT_EQ(text("lane ", std::string("a"), " ends at ", 12.5, " m, ", 3, '.'), "lane a ends at 12.5 m, 3.");
  EXPECT_EQ(text(4137624.25), "4137624.25");
}

TEST(Text, WritesPointsPosesAndLengths) {
  EXPECT_EQ(at(Point2d(12.3, -4.5)), "(12.30, -4.50)");
  EXPECT_EQ(at(Pose2d{12.3, 4.5, M_PI / 2}), "(12.30, 4.50, 1.571)");
  EXPECT_EQ(metres(7.1), "7.10 m");
  EXPECT_EQ(radians(M_PI), "3.14 rad");
  EXPECT_EQ(seconds(1.0 / 3.0), "0.33 s");
}

TEST(Text, SurvivesAnyNumber) {
  EXPECT_EQ(at(Point2d(1e308, -1e308)), "(1e+308, -1e+308)");
  EXPECT_EQ(at(Pose2d{-1e308, 1e12, 1e17}), "(-1e+308, 1e+12, 1e+17)");
  EXPECT_EQ(radians(-1e308), "-1e+308 rad");
  EXPECT_EQ(seconds(4294967295.0), "4294967295.00 s");
  EXPECT_EQ(metres(std::nan("")), "nan m");
  EXPECT_EQ(metres(-INFINITY), "-inf m");
}

}  // namespace
}  // namespace external_command
