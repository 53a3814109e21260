// SPDX-License-Identifier: Apache-2.0
#include "nodelets/mode_switch.h"

#include <gtest/gtest.h>

#include "external_command/Chassis.h"

namespace external_command {
namespace {

using Step = ModeSwitch::Step;
using Target = ModeSwitch::Target;

constexpr std::uint8_t kManual = Chassis::COMPLETE_MANUAL;
constexpr std::uint8_t kAuto = Chassis::COMPLETE_AUTO_DRIVE;
constexpr std::uint8_t kSteerOnly = Chassis::AUTO_STEER_ONLY;

ModeSwitch switchTo(Target target, bool is_settled = true) {
  return ModeSwitch(target, ModeSwitchParams(), is_settled);
}

TEST(ModeSwitch, IsDoneAtOnceInTheModeAlready) {
  EXPECT_EQ(switchTo(Target::kManual).next(kManual, 0.0), Step::kDone);
  EXPECT_EQ(switchTo(Target::kAuto).next(kAuto, 0.0), Step::kDone);
}

TEST(ModeSwitch, AsksForManualUntilTheChassisReportsIt) {
  ModeSwitch to_manual = switchTo(Target::kManual);
  EXPECT_EQ(to_manual.next(kAuto, 0.0), Step::kSendManual);
  EXPECT_EQ(to_manual.next(kAuto, 0.49), Step::kWait);
  EXPECT_EQ(to_manual.next(kAuto, 0.5), Step::kSendManual);
  EXPECT_EQ(to_manual.next(kManual, 0.6), Step::kDone);
}

TEST(ModeSwitch, GoesThroughManualToAuto) {
  ModeSwitch to_auto = switchTo(Target::kAuto);
  EXPECT_EQ(to_auto.next(kSteerOnly, 0.0), Step::kSendManual);
  EXPECT_EQ(to_auto.next(kManual, 0.1), Step::kSendAuto) << "at once, not after the interval";
  EXPECT_EQ(to_auto.next(kManual, 0.2), Step::kWait);
  EXPECT_EQ(to_auto.next(kAuto, 0.3), Step::kDone);
}

TEST(ModeSwitch, AsksForAutoAtOnceInManual) {
  ModeSwitch to_auto = switchTo(Target::kAuto);
  EXPECT_EQ(to_auto.next(kManual, 0.0), Step::kSendAuto);
  EXPECT_EQ(to_auto.next(kAuto, 0.1), Step::kDone);
}

TEST(ModeSwitch, GivesUpAfterItsTries) {
  ModeSwitch to_manual = switchTo(Target::kManual);
  int sent = 0;
  double now = 0.0;
  for (Step step = Step::kWait; step != Step::kFailed && now < 10.0; now += 0.05) {
    step = to_manual.next(kAuto, now);
    sent += step == Step::kSendManual;
    if (step == Step::kFailed) {
      EXPECT_NEAR(now, 1.5, 0.06);
    }
  }
  EXPECT_EQ(sent, 3);
  EXPECT_LT(now, 2.0);
  EXPECT_NE(to_manual.describe(kAuto).find("COMPLETE_MANUAL 3 of 3 times"), std::string::npos);
  EXPECT_NE(to_manual.describe(kAuto).find("reports COMPLETE_AUTO_DRIVE"), std::string::npos);
}

TEST(ModeSwitch, HasItsTriesForEachOfTheTwoModes) {
  ModeSwitch to_auto = switchTo(Target::kAuto);
  for (const double now : {0.0, 0.5, 1.0}) EXPECT_EQ(to_auto.next(kSteerOnly, now), Step::kSendManual);
  for (const double now : {1.2, 1.7, 2.2}) EXPECT_EQ(to_auto.next(kManual, now), Step::kSendAuto);
  EXPECT_EQ(to_auto.next(kManual, 2.7), Step::kFailed);
}

TEST(ModeSwitch, DoesNotTrustTheReportedModeWhileAnEarlierSwitchMayStillTakeEffect) {
  ModeSwitch to_manual = switchTo(Target::kManual, false);
  EXPECT_EQ(to_manual.next(kManual, 0.0), Step::kSendManual);
  EXPECT_EQ(to_manual.next(kManual, 0.1), Step::kDone);
  ModeSwitch to_auto = switchTo(Target::kAuto, false);
  EXPECT_EQ(to_auto.next(kAuto, 0.0), Step::kSendManual);
  EXPECT_EQ(to_auto.next(kAuto, 0.1), Step::kWait) << "auto counts only after manual";
  EXPECT_EQ(to_auto.next(kManual, 0.2), Step::kSendAuto);
}

}  // namespace
}  // namespace external_command
