// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"

namespace external_command {
namespace {

std::string refusalOf(const PathBounds& bounds, double length, double points) {
  try {
    bounds.require(length, points);
  } catch (const InvalidRequest& refused) {
    return refused.what();
  }
  return "";
}

TEST(PathBounds, TakePathsUpToTheLimits) {
  const PathBounds bounds{100.0, 50};
  EXPECT_EQ(refusalOf(bounds, 100.0, 50.0), "");
  EXPECT_EQ(refusalOf(bounds, 0.0, 0.0), "");
  EXPECT_NO_THROW(bounds.require(Path(50)));
}

TEST(PathBounds, RefuseLargerOnesWithBothValuesAndTheParameter) {
  const PathBounds bounds{100.0, 50};
  EXPECT_EQ(refusalOf(bounds, 100.5, 2.0),
            "the path is too long: 100.50 m; the limit is 100.00 m (~routing/max_path_length)");
  EXPECT_NE(refusalOf(bounds, 10.0, 51.0).find("too many points: 51; the limit is 50 (~routing/max_path_points)"),
            std::string::npos);
  EXPECT_THROW(bounds.require(Path(51)), InvalidRequest);
}

TEST(PathBounds, RefuseWhatIsNoNumber) {
  EXPECT_NE(refusalOf({}, std::nan(""), 2.0), "");
  EXPECT_NE(refusalOf({}, 2.0, std::nan("")), "");
  EXPECT_NE(refusalOf({}, INFINITY, 2.0).find("inf m;"), std::string::npos);
}

TEST(PathBounds, AreThemselvesWithinBounds) {
  EXPECT_NO_THROW(PathBounds().validate());
  EXPECT_THROW((PathBounds{0.0, 50}.validate()), InvalidParameter);
  EXPECT_THROW((PathBounds{std::nan(""), 50}.validate()), InvalidParameter);
  EXPECT_THROW((PathBounds{100.0, 1}.validate()), InvalidParameter);
}

}  // namespace
}  // namespace external_command
