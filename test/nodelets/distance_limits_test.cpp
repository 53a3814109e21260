// SPDX-License-Identifier: Apache-2.0
#include "nodelets/distance_limits.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "external_command/core/error.h"

namespace external_command {
namespace {

std::vector<std::string> warningsOf(const DistanceLimits& limits, double distance) {
  std::vector<std::string> warnings;
  limits.check("the path begins at", "start", {distance, 0.0}, {0.0, 0.0}, &warnings);
  return warnings;
}

TEST(DistanceLimits, WarnOfWhatIsFartherAway) {
  EXPECT_TRUE(warningsOf({5.0, 0.0}, 5.0).empty());
  const std::vector<std::string> warnings = warningsOf({5.0, 0.0}, 5.1);
  ASSERT_EQ(warnings.size(), 1u);
  for (const char* words : {"the path begins at (5.10, 0.00)", "5.10 m", "~start_distance_warning"}) {
    EXPECT_NE(warnings[0].find(words), std::string::npos) << warnings[0];
  }
}

TEST(DistanceLimits, RefuseOnlyWhereThatIsWished) {
  EXPECT_EQ(warningsOf({5.0, 0.0}, 1e5).size(), 1u);
  EXPECT_EQ(warningsOf({5.0, 20.0}, 19.0).size(), 1u);
  try {
    warningsOf({5.0, 20.0}, 21.0);
    FAIL() << "not refused";
  } catch (const InvalidRequest& error) {
    EXPECT_NE(std::string(error.what()).find("20.00 m (~max_start_distance)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace external_command
