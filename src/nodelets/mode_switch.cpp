// SPDX-License-Identifier: Apache-2.0
#include "mode_switch.h"

#include "external_command/Chassis.h"
#include "external_command/core/text.h"

namespace external_command {

ModeSwitch::ModeSwitch(Target target, const ModeSwitchParams& params, bool is_settled)
    : target_(target), params_(params), is_settled_(is_settled) {}

std::uint8_t ModeSwitch::wantedMode() const {
  return asks_for_auto_ ? Chassis::COMPLETE_AUTO_DRIVE : Chassis::COMPLETE_MANUAL;
}

ModeSwitch::Step ModeSwitch::next(std::uint8_t mode, double now) {
  const std::uint8_t goal = target_ == Target::kAuto ? Chassis::COMPLETE_AUTO_DRIVE : Chassis::COMPLETE_MANUAL;
  const bool nothing_sent = tries_ == 0 && !asks_for_auto_;
  const bool counts = is_settled_ || !nothing_sent;
  if (counts && mode == goal && (nothing_sent || wantedMode() == goal)) return Step::kDone;
  if (counts && mode == wantedMode()) {
    asks_for_auto_ = true;
    tries_ = 0;
  }
  if (tries_ > 0 && now - last_try_ < params_.interval) return Step::kWait;
  if (tries_ == params_.tries) return Step::kFailed;
  ++tries_;
  last_try_ = now;
  return asks_for_auto_ ? Step::kSendAuto : Step::kSendManual;
}

std::string ModeSwitch::describe(std::uint8_t mode) const {
  return text("the chassis was asked for ", nameOfMode(wantedMode()), " ", tries_, " of ", params_.tries,
              " times (~mode_switch_tries), ", params_.interval, " s apart (~mode_switch_interval); it reports ",
              nameOfMode(mode));
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
