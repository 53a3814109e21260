// SPDX-License-Identifier: Apache-2.0
#include "coverage/work/stretches.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace external_command {
namespace {

constexpr double kNoWay = std::numeric_limits<double>::infinity();

/// Of a line of 20 columns with something in columns 9 and 10. A column is worth 3, and costs 1; a beginning costs 5.
std::vector<Stretch> stretchesWith(double toll) {
  StretchSearch search(5.0, 1.0);
  search.best(
      20, [](int) { return 3.0; },
      [toll](int column, bool begins) {
        if (column != 9 && column != 10) return 0.0;
        return begins ? kNoWay : column == 9 ? toll : 0.0;
      });
  return search.stretches();
}

TEST(StretchSearch, PaysATollThatIsLessThanAnotherBeginning) {
  const std::vector<Stretch> stretches = stretchesWith(8.0);
  ASSERT_EQ(stretches.size(), 1u);
  EXPECT_EQ(stretches[0].begin, 0);
  EXPECT_EQ(stretches[0].end, 20);
}

TEST(StretchSearch, EndsBeforeATollThatIsMore) {
  for (const double toll : {10.0, kNoWay}) {
    const std::vector<Stretch> stretches = stretchesWith(toll);
    ASSERT_EQ(stretches.size(), 2u) << toll;
    EXPECT_EQ(stretches[0].end, 9);
    EXPECT_EQ(stretches[1].begin, 11) << "not where it cannot be";
  }
}

TEST(StretchSearch, FindsNothingWhereTheVehicleCannotBe) {
  StretchSearch search(5.0, 1.0);
  EXPECT_EQ(search.best(
                20, [](int) { return 3.0; }, [](int, bool) { return kNoWay; }),
            0.0);
  EXPECT_TRUE(search.stretches().empty());
}

}  // namespace
}  // namespace external_command
