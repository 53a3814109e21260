// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/parameter_range.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "external_command/core/error.h"

namespace external_command {
namespace {

TEST(ParameterRange, HoldsItsEnds) {
  EXPECT_NO_THROW(requireParameter("width", 0.1, 0.1, 10.0));
  EXPECT_NO_THROW(requireParameter("width", 10.0, 0.1, 10.0));
}

TEST(ParameterRange, RefusesWhatLiesBeyondWithNameValueAndRange) {
  try {
    requireParameter("vehicle/width", 11.0, 0.1, 10.0);
    FAIL() << "11 was taken";
  } catch (const InvalidParameter& error) {
    EXPECT_STREQ(error.what(), "vehicle/width is 11; it must lie in [0.1, 10]");
  }
  EXPECT_THROW(requireParameter("width", -1.0, 0.1, 10.0), InvalidParameter);
}

TEST(ParameterRange, RefusesWhatIsNoNumber) {
  EXPECT_THROW(requireParameter("width", std::numeric_limits<double>::quiet_NaN(), 0.1, 10.0), InvalidParameter);
}

TEST(ParameterRange, SaysPiWhereTheRangeEndsThere) {
  try {
    requireParameter("heading", 4.0, 0.0, M_PI);
    FAIL() << "4 was taken";
  } catch (const InvalidParameter& error) {
    EXPECT_STREQ(error.what(), "heading is 4; it must lie in [0, pi]");
  }
}

}  // namespace
}  // namespace external_command
