// SPDX-License-Identifier: Apache-2.0
#include "../benchmark/line_sample.h"

#include <gtest/gtest.h>

namespace external_command {
namespace benchmark {
namespace {

using Rings = std::vector<std::vector<Point2d>>;

std::vector<Point2d> rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

const Point2d kOrigin(5e5, 4e6);
const Lines kLines(kOrigin, 0.02);

LineSample sampleOf(const Rings& shapes) {
  LineSample sample;
  for (std::vector<Point2d> shape : shapes) {
    for (Point2d& point : shape) point += kOrigin;
    kLines.add(Rings{shape}, &sample);
  }
  return sample;
}

TEST(LineSample, MeasuresAreas) {
  EXPECT_NEAR(kLines.area(sampleOf({rectangle(0, 0, 20, 1.6)})), 32.0, 0.01);
  EXPECT_NEAR(kLines.area(sampleOf({{{0, 0}, {10, 1}, {3, 8}}})), 38.5, 0.01);
}

TEST(LineSample, CountsWhatOverlapsOnceAfterMerging) {
  LineSample sample = sampleOf({rectangle(0, 0, 10, 4), rectangle(5, 0, 15, 4), rectangle(30, 0, 31, 1)});
  EXPECT_NEAR(kLines.area(sample), 81.0, 0.02);
  sample.merge();
  EXPECT_NEAR(kLines.area(sample), 61.0, 0.02);
}

TEST(LineSample, CutsShapes) {
  LineSample whole = sampleOf({rectangle(0, 0, 20, 10)}),
             cut = sampleOf({rectangle(5, 2, 7, 4), rectangle(15, -5, 25, 5)});
  whole.merge();
  cut.merge();
  EXPECT_NEAR(kLines.area(whole.common(cut)), 29.0, 0.02);
  EXPECT_NEAR(kLines.area(whole.without(cut)), 171.0, 0.02);
  EXPECT_NEAR(kLines.area(cut.without(whole)), 75.0, 0.02);
}

TEST(LineSample, OfNothingIsEmpty) {
  LineSample nothing;
  nothing.merge();
  EXPECT_EQ(kLines.area(nothing), 0.0);
  EXPECT_EQ(kLines.area(nothing.common(sampleOf({rectangle(0, 0, 1, 1)}))), 0.0);
}

}  // namespace
}  // namespace benchmark
}  // namespace external_command
