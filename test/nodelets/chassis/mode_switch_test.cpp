// SPDX-License-Identifier: Apache-2.0
#include "nodelets/chassis/mode_switch.h"

#include <gtest/gtest.h>

#include "external_command/Chassis.h"

namespace external_command {
namespace {

using Step = ModeSwitch::Step;
using Target = ModeSwitch::Target;

constexpr std::uint8_t kManual = Chassis::COMPLETE_MANUAL;
constexpr std::uint8_t kAuto = Chassis::COMPLETE_AUTO_DRIVE;
constexpr std::uint8_t kSteerOnly = Chassis::AUTO_STEER_ONLY;

/// A mode switch asked for at time 10, and a chassis that reports all the time.
class Switch {
 public:
  explicit Switch(Target target, bool is_settled = true) : decision_(target, ModeSwitchParams(), is_settled, 10.0) {}

  Step hears(std::uint8_t mode, double now) { return decision_.next(ReportedMode{mode, now}, now); }
  Step remembers(std::uint8_t mode, double reported, double now) {
    return decision_.next(ReportedMode{mode, reported}, now);
  }
  Step hearsNothing(double now) { return decision_.next(std::nullopt, now); }

  ModeSwitch decision_;
};

TEST(ModeSwitch, AsksForManualUntilTheChassisReportsIt) {
  Switch to_manual(Target::kManual);
  EXPECT_EQ(to_manual.hears(kAuto, 10.0), Step::kSendManual);
  EXPECT_EQ(to_manual.hears(kAuto, 10.49), Step::kWait);
  EXPECT_EQ(to_manual.hears(kAuto, 10.5), Step::kSendManual);
  EXPECT_EQ(to_manual.hears(kManual, 10.6), Step::kDone);
}

TEST(ModeSwitch, TakesOnlyAReportNewerThanWhatWasSentForManual) {
  Switch to_manual(Target::kManual);
  EXPECT_EQ(to_manual.remembers(kManual, 9.9, 10.0), Step::kSendManual) << "though it was in manual";
  EXPECT_EQ(to_manual.remembers(kManual, 9.9, 10.02), Step::kWait);
  EXPECT_EQ(to_manual.remembers(kManual, 10.03, 10.04), Step::kDone);
}

TEST(ModeSwitch, AsksForManualWithoutAnyReportAndFailsUnconfirmed) {
  Switch to_manual(Target::kManual);
  for (const double now : {10.0, 10.5, 11.0}) EXPECT_EQ(to_manual.hearsNothing(now), Step::kSendManual);
  EXPECT_EQ(to_manual.hearsNothing(11.5), Step::kFailed);
  EXPECT_NE(to_manual.decision_.describe(std::nullopt).find("not confirmed"), std::string::npos);
}

TEST(ModeSwitch, GoesThroughManualToAuto) {
  Switch to_auto(Target::kAuto);
  EXPECT_EQ(to_auto.hears(kSteerOnly, 10.01), Step::kSendManual);
  EXPECT_EQ(to_auto.hears(kManual, 10.1), Step::kSendAuto) << "at once, not after the interval";
  EXPECT_EQ(to_auto.hears(kManual, 10.2), Step::kWait);
  EXPECT_EQ(to_auto.hears(kAuto, 10.3), Step::kDone);
}

TEST(ModeSwitch, LooksAtTheChassisBeforeItAsksForAuto) {
  Switch in_auto(Target::kAuto);
  EXPECT_EQ(in_auto.remembers(kAuto, 9.99, 10.0), Step::kWait) << "an old report tells nothing";
  EXPECT_EQ(in_auto.hears(kAuto, 10.05), Step::kDone);
  Switch in_manual(Target::kAuto);
  EXPECT_EQ(in_manual.hears(kManual, 10.05), Step::kSendAuto);
  EXPECT_EQ(in_manual.hears(kAuto, 10.1), Step::kDone);
  Switch unheard(Target::kAuto);
  EXPECT_EQ(unheard.hearsNothing(10.4), Step::kWait);
  EXPECT_EQ(unheard.hearsNothing(10.5), Step::kSendManual);
}

TEST(ModeSwitch, GivesUpAfterItsTries) {
  Switch to_manual(Target::kManual);
  int sent = 0;
  double now = 10.0;
  for (Step step = Step::kWait; step != Step::kFailed && now < 20.0; now += 0.05) {
    step = to_manual.hears(kAuto, now);
    sent += step == Step::kSendManual;
    if (step == Step::kFailed) {
      EXPECT_NEAR(now, 11.5, 0.06);
    }
  }
  EXPECT_EQ(sent, 3);
  EXPECT_LT(now, 12.0);
  const std::string why = to_manual.decision_.describe(ReportedMode{kAuto, now});
  EXPECT_NE(why.find("COMPLETE_MANUAL 3 of 3 times"), std::string::npos) << why;
  EXPECT_NE(why.find("reports COMPLETE_AUTO_DRIVE"), std::string::npos) << why;
}

TEST(ModeSwitch, HasItsTriesForEachOfTheTwoModes) {
  Switch to_auto(Target::kAuto);
  for (const double now : {10.1, 10.6, 11.1}) EXPECT_EQ(to_auto.hears(kSteerOnly, now), Step::kSendManual);
  for (const double now : {11.2, 11.7, 12.2}) EXPECT_EQ(to_auto.hears(kManual, now), Step::kSendAuto);
  EXPECT_EQ(to_auto.hears(kManual, 12.7), Step::kFailed);
}

TEST(ModeSwitch, DoesNotTrustTheReportedModeWhileAnEarlierSwitchMayStillTakeEffect) {
  Switch to_auto(Target::kAuto, false);
  EXPECT_EQ(to_auto.hears(kAuto, 10.01), Step::kSendManual);
  EXPECT_EQ(to_auto.hears(kAuto, 10.1), Step::kWait) << "auto counts only after manual";
  EXPECT_EQ(to_auto.hears(kManual, 10.2), Step::kSendAuto);
}

}  // namespace
}  // namespace external_command
