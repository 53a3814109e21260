// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/path_bounds.h"

#include <gtest/gtest.h>

#include <cmath>

#include "external_command/core/error.h"
#include "support/refusal.h"

namespace external_command {
namespace {

std::string lengthRefusal(const PathBounds& bounds, double length, double points) {
  return refusalOf([&] { bounds.require(length, points); });
}

TEST(PathBounds, TakePathsUpToTheLimits) {
  const PathBounds bounds{100.0, 50};
  EXPECT_EQ(lengthRefusal(bounds, 100.0, 50.0), "");
  EXPECT_EQ(lengthRefusal(bounds, 0.0, 0.0), "");
  EXPECT_NO_THROW(bounds.require(Path(50)));
}

TEST(PathBounds, RefuseLargerOnesWithBothValuesAndTheParameter) {
  const PathBounds bounds{100.0, 50};
  EXPECT_EQ(lengthRefusal(bounds, 100.5, 2.0),
            "the path is too long: 100.50 m; the limit is 100.00 m (~routing/max_path_length)");
  EXPECT_NE(lengthRefusal(bounds, 10.0, 51.0).find("too many points: 51; the limit is 50 (~routing/max_path_points)"),
            std::string::npos);
  EXPECT_THROW(bounds.require(Path(51)), InvalidRequest);
}

TEST(PathBounds, RefuseWhatIsNoNumber) {
  EXPECT_NE(lengthRefusal({}, std::nan(""), 2.0), "");
  EXPECT_NE(lengthRefusal({}, 2.0, std::nan("")), "");
  EXPECT_NE(lengthRefusal({}, INFINITY, 2.0).find("inf m;"), std::string::npos);
}

TEST(PathBounds, AreThemselvesWithinBounds) {
  EXPECT_NO_THROW(PathBounds().validate());
  EXPECT_THROW((PathBounds{0.0, 50}.validate()), InvalidParameter);
  EXPECT_THROW((PathBounds{std::nan(""), 50}.validate()), InvalidParameter);
  EXPECT_THROW((PathBounds{100.0, 1}.validate()), InvalidParameter);
}

}  // namespace
}  // namespace external_command
