// SPDX-License-Identifier: Apache-2.0
#include "mode_switch.h"

#include "external_command/Chassis.h"
#include "external_command/core/text.h"

namespace external_command {

ModeSwitch::ModeSwitch(Target target, const ModeSwitchParams& params, bool is_settled, double now)
    : target_(target), params_(params), asked_at_(now), looks_first_(is_settled && target == Target::kAuto) {}

std::uint8_t ModeSwitch::wantedMode() const {
  return asks_for_auto_ ? Chassis::COMPLETE_AUTO_DRIVE : Chassis::COMPLETE_MANUAL;
}

/// To auto, RESET would throw out a chassis that is in it already, and is of no use to one that is in manual.
std::optional<ModeSwitch::Step> ModeSwitch::firstStep(const std::optional<ReportedMode>& reported, double now) {
  const bool is_news = reported && reported->time > asked_at_;
  if (!is_news && now - asked_at_ < params_.interval) return Step::kWait;
  looks_first_ = false;
  if (is_news && reported->mode == Chassis::COMPLETE_AUTO_DRIVE) return Step::kDone;
  asks_for_auto_ = is_news && reported->mode == Chassis::COMPLETE_MANUAL;
  return std::nullopt;
}

ModeSwitch::Step ModeSwitch::next(const std::optional<ReportedMode>& reported, double now) {
  if (looks_first_) {
    if (const auto step = firstStep(reported, now)) return *step;
  }
  const bool is_confirmed = tries_ > 0 && reported && reported->time > first_try_ && reported->mode == wantedMode();
  if (is_confirmed && (asks_for_auto_ || target_ == Target::kManual)) return Step::kDone;
  if (is_confirmed) {
    asks_for_auto_ = true;
    tries_ = 0;
  }
  if (tries_ > 0 && now - last_try_ < params_.interval) return Step::kWait;
  if (tries_ == params_.tries) return Step::kFailed;
  if (tries_ == 0) first_try_ = now;
  ++tries_;
  last_try_ = now;
  return asks_for_auto_ ? Step::kSendAuto : Step::kSendManual;
}

std::string ModeSwitch::describe(const std::optional<ReportedMode>& reported) const {
  if (looks_first_) return "waiting for a report of the chassis";
  const std::string asked =
      text("the chassis was asked for ", nameOfMode(wantedMode()), " ", tries_, " of ", params_.tries,
           " times (~mode_switch_tries), ", seconds(params_.interval), " apart (~mode_switch_interval); ");
  const bool is_news = reported && tries_ > 0 && reported->time > first_try_;
  if (is_news) return asked + "it reports " + nameOfMode(reported->mode);
  return asked + "not confirmed: it has reported nothing since";
}

std::string nameOfMode(std::uint8_t mode) {
  switch (mode) {
    case Chassis::COMPLETE_MANUAL:
      return "COMPLETE_MANUAL";
    case Chassis::COMPLETE_AUTO_DRIVE:
      return "COMPLETE_AUTO_DRIVE";
    case Chassis::AUTO_STEER_ONLY:
      return "AUTO_STEER_ONLY";
    case Chassis::AUTO_SPEED_ONLY:
      return "AUTO_SPEED_ONLY";
    case Chassis::EMERGENCY_MODE:
      return "EMERGENCY_MODE";
    default:
      return text("driving mode ", static_cast<int>(mode));
  }
}

}  // namespace external_command
