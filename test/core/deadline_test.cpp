// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/deadline.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(Deadline, TellsWhatIsLeft) {
  const Deadline deadline(100.0);
  EXPECT_LE(deadline.left(), 100.0);
  EXPECT_GT(deadline.left(), 50.0);
  EXPECT_FALSE(deadline.hasPassed());
}

TEST(Deadline, HasPassedWhereThereWasNoTime) {
  EXPECT_TRUE(Deadline(0.0).hasPassed());
  EXPECT_EQ(Deadline(-5.0).left(), 0.0);
}

TEST(Deadline, IsDividedAmongSteps) {
  const Deadline whole(100.0);
  EXPECT_LE(whole.part(0.25).left(), 25.0);
  EXPECT_GT(whole.part(0.25).left(), 12.0);
  EXPECT_LE(whole.orSooner(Deadline(3.0)).left(), 3.0);
  EXPECT_LE(Deadline(3.0).orSooner(whole).left(), 3.0);
}

}  // namespace
}  // namespace external_command
