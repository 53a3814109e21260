// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/plans_in_work.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(PlansInWork, CancelsEveryPlanThatIsInWork) {
  PlansInWork plans;
  const CancelSource first, second;
  const PlansInWork::Entry first_entry(&plans, first), second_entry(&plans, second);
  EXPECT_EQ(plans.size(), 2u);
  EXPECT_FALSE(first.token().isCancelled());
  plans.cancelForGood();
  EXPECT_TRUE(first.token().isCancelled());
  EXPECT_TRUE(second.token().isCancelled());
}

TEST(PlansInWork, LeavesAPlanAloneThatHasEnded) {
  PlansInWork plans;
  const CancelSource ended;
  { const PlansInWork::Entry entry(&plans, ended); }
  EXPECT_EQ(plans.size(), 0u);
  plans.cancelForGood();
  EXPECT_FALSE(ended.token().isCancelled());
}

TEST(PlansInWork, CancelsAPlanThatComesTooLate) {
  PlansInWork plans;
  EXPECT_FALSE(plans.areCancelled());
  plans.cancelForGood();
  EXPECT_TRUE(plans.areCancelled());
  const CancelSource late;
  const PlansInWork::Entry entry(&plans, late);
  EXPECT_TRUE(late.token().isCancelled());
}

}  // namespace
}  // namespace external_command
