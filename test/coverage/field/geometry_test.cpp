// SPDX-License-Identifier: Apache-2.0
// Borders that are moved in or out.
#include "coverage/field/geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "external_command/core/error.h"

namespace external_command {
namespace {

const Checkpoint kGoOn = [] {};

/// A square of 100 m with corners on its sides, too, so many in all.
shapes::Shapes square(int corners) {
  std::vector<Point2d> points;
  const int side = corners / 4;
  for (int i = 0; i < 4 * side; ++i) {
    const double along = 100.0 * (i % side) / side;
    const std::vector<Point2d> sides{{along, 0.0}, {100.0, along}, {100.0 - along, 100.0}, {0.0, 100.0 - along}};
    points.push_back(sides[static_cast<std::size_t>(i / side)]);
  }
  return only(shapeOf(points));
}

TEST(Grown, MovesABorderOfManyCornersAsOneOfFew) {
  const double rounded = (4.0 - M_PI) * 4.0;  // that the square of 104 m lacks at its corners [m^2]
  for (const int corners : {4, 4000}) {
    EXPECT_NEAR(areaOf(grown(square(corners), 2.0, kGoOn)), 104.0 * 104.0 - rounded, 0.1) << corners;
    EXPECT_NEAR(areaOf(grown(square(corners), -2.0, kGoOn)), 96.0 * 96.0, 0.1) << corners;
  }
}

TEST(Grown, AsksMeanwhileWhetherToGoOnHoweverManyCornersThereAre) {
  int asked = 0;
  const Checkpoint stop = [&asked] {
    if (++asked > 5) throw Cancelled("enough");
  };
  EXPECT_THROW(grown(square(4000), -2.0, stop), Cancelled);
}

}  // namespace
}  // namespace external_command
