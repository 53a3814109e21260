// SPDX-License-Identifier: Apache-2.0
#include "external_command/coverage/coverage_progress.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <string>

#include "external_command/core/error.h"
#include "support/zone_plans.h"

namespace external_command {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

Polygon yard() { return Polygon({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, "the yard"); }

void require(const CoverageProgress& progress) {
  requirePlausible(progress, yard(), VehicleParams(), CoverageParams());
}

TEST(CoverageProgress, KnowsWhatIsSwept) {
  CoverageProgress progress = lapAndSwaths();
  EXPECT_EQ(progress.countDone(), 0u);
  EXPECT_TRUE(progress.sweep(1, 12.0));
  EXPECT_EQ(progress.sweptOf(1), 12.0);
  EXPECT_FALSE(progress.isDone(1)) << "8 m of it are left";
  EXPECT_FALSE(progress.sweep(1, 3.0)) << "nothing is ever unswept";
  EXPECT_EQ(progress.sweptOf(1), 12.0);
  progress.sweep(1, 19.9);
  EXPECT_TRUE(progress.isDone(1)) << "a vehicle is not sent back for 10 cm";
  EXPECT_EQ(progress.countDone(), 1u);
  progress.sweep(2, 1000.0);
  EXPECT_EQ(progress.sweptOf(2), progress.lines[2].length());
}

TEST(CoverageProgress, SkipsNoLongerWhatIsDone) {
  CoverageProgress progress = lapAndSwaths();
  progress.skipped = {1, 2};
  progress.sweep(1, 5.0);
  EXPECT_TRUE(progress.isSkipped(1));
  progress.sweep(1, 20.0);
  EXPECT_FALSE(progress.isSkipped(1));
  EXPECT_TRUE(progress.isSkipped(2));
}

TEST(CoverageProgress, IsCheckedNoLongerOnceCancelled) {
  const CancelSource source;
  EXPECT_NO_THROW(requirePlausible(lapAndSwaths(), yard(), VehicleParams(), CoverageParams(), source.token()));
  source.cancel();
  EXPECT_THROW(requirePlausible(lapAndSwaths(), yard(), VehicleParams(), CoverageParams(), source.token()), Cancelled);
}

TEST(CoverageProgress, TakesOverWhatAnotherRunHasSwept) {
  CoverageProgress progress = lapAndSwaths(), other = lapAndSwaths();
  progress.sweep(0, 50.0);
  other.sweep(0, 30.0);
  other.sweep(1, 7.0);
  progress.merge(other);
  EXPECT_EQ(progress.sweptOf(0), 50.0);
  EXPECT_EQ(progress.sweptOf(1), 7.0);
}

TEST(CoverageProgress, IsPlausibleAsPlanned) {
  CoverageProgress progress = lapAndSwaths();
  EXPECT_NO_THROW(require({}));
  EXPECT_NO_THROW(require(progress));
  progress.sweep(0, 40.0);
  progress.skipped = {2};
  EXPECT_NO_THROW(require(progress));
}

struct Fault {
  const char* what;  ///< that the text must tell
  std::function<void(CoverageProgress*)> make;
};

TEST(CoverageProgress, IsRefusedWithANumberThatCannotBe) {
  using P = CoverageProgress;
  const Fault faults[] = {
      {"swath 1 leaves the area", [](P* p) { p->lines[1].start.x = 1e300; }},
      {"swath 1 leaves the area", [](P* p) { p->lines[1].start.y = kNan; }},
      {"swath 1 leaves the area", [](P* p) { p->lines[1].start.x = 25.0; }},
      {"swath 1 leaves the area", [](P* p) { p->lines[1].start.heading = -1.0; }},
      {"swath 1 begins with no heading", [](P* p) { p->lines[1].start.heading = kNan; }},
      {"swath 1 leaves the area", [](P* p) { p->lines[1].arcs[0].length = 40.0; }},
      {"longer than", [](P* p) { p->lines[1].arcs[0].length = 1e12; }},
      {"longer than", [](P* p) { p->lines[1].arcs[0].length = kNan; }},
      {"longer than the",
       [](P* p) {
         p->lines[1].arcs[0] = {1000.0, 2.0 * M_PI / 1000.0};
       }},
      {"longer than", [](P* p) { p->lines[0].arcs[1].length = 1e4 * 2.0 * M_PI * 5.0; }},
      {"swath 0 bends by", [](P* p) { p->lines[0].arcs[1].kappa = 2.0; }},
      {"swath 0 bends by", [](P* p) { p->lines[0].arcs[1].kappa = kNan; }},
      {"swath 2 has no length", [](P* p) { p->lines[2].arcs.clear(); }},
      {"lap 100000", [](P* p) { p->lines[2].lap = 100000; }},
      {"lap -2", [](P* p) { p->lines[2].lap = -2; }},
      {"swath 1 is 20.00 m long",
       [](P* p) {
         p->swept = {0.0, 20.5};
       }},
      {"swath 1 is 20.00 m long",
       [](P* p) {
         p->swept = {0.0, -1.0};
       }},
      {"swath 1 is 20.00 m long",
       [](P* p) {
         p->swept = {0.0, kNan};
       }},
      {"progress of 4 swaths",
       [](P* p) {
         p->swept = {0.0, 0.0, 0.0, 0.0};
       }},
      {"skipped swath 3", [](P* p) { p->skipped = {3}; }},
      {"skipped twice",
       [](P* p) {
         p->skipped = {1, 1};
       }},
      {"swaths with", [](P* p) { p->lines.resize(P::kMostLines + 1); }},
      {"arcs; at most", [](P* p) { p->lines[0].arcs.resize(P::kMostArcs + 1); }},
  };
  for (const Fault& fault : faults) {
    CoverageProgress progress = lapAndSwaths();
    fault.make(&progress);
    try {
      require(progress);
      ADD_FAILURE() << "accepted: " << fault.what;
    } catch (const InvalidRequest& error) {
      EXPECT_NE(std::string(error.what()).find(fault.what), std::string::npos) << error.what();
    }
  }
}

TEST(CoverageProgress, OfAHundredThousandArcsIsLookedAtQuickly) {
  CoverageProgress progress;
  for (int line = 0; line < 1000; ++line) {
    progress.lines.push_back({{10.0, 1.0 + 0.02 * line, 0.0}, std::vector<ArcSegment>(100, {0.02, 0.0}), 0});
  }
  const auto begin = std::chrono::steady_clock::now();
  require(progress);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(1));
}

}  // namespace
}  // namespace external_command
