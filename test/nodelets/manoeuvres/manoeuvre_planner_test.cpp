// SPDX-License-Identifier: Apache-2.0
#include "nodelets/manoeuvres/manoeuvre_planner.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(TimeoutWords, AreThoseOfAPartThatHadAllTheTime) {
  EXPECT_EQ(timeoutWords("none was found within 0.99 s", 0.99, 1.0, "free_space/time_budget"),
            "none was found within 0.99 s");
}

TEST(TimeoutWords, SayWhereTheRestOfTheTimeWent) {
  EXPECT_EQ(timeoutWords("none was found within 0.01 s", 0.01, 1.0, "free_space/time_budget"),
            "none was found within 0.01 s; the other parts of the command have the rest of its 1.00 s "
            "(~free_space/time_budget)");
}

}  // namespace
}  // namespace external_command
