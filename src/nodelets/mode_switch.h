// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

namespace external_command {

struct ModeSwitchParams {
  int tries = 3;          ///< how often a mode is asked for
  double interval = 0.5;  ///< between two tries, and after the last [s]
};

/// Decides what to send to bring the chassis into a driving mode, from what it reports. Modes are Chassis's constants.
///
///   to manual:  ask for manual until the chassis reports it
///   to auto:    the same, then ask for auto until the chassis reports that
class ModeSwitch {
 public:
  enum class Target { kManual, kAuto };
  enum class Step { kWait, kSendManual, kSendAuto, kDone, kFailed };

  /// @param is_settled  false where the chassis may still be carrying out an earlier switch: what it reports then does
  ///                    not count before something was sent.
  ModeSwitch(Target target, const ModeSwitchParams& params, bool is_settled);

  /// What is to be done now. To be called with every report of the chassis and, with its last one, at short intervals.
  /// @param mode  that the chassis reports.
  /// @param now   [s], of any steady clock.
  Step next(std::uint8_t mode, double now);

  /// What it waits for, or why it failed.
  std::string describe(std::uint8_t mode) const;

 private:
  std::uint8_t wantedMode() const;

  const Target target_;
  const ModeSwitchParams params_;
  const bool is_settled_;
  bool asks_for_auto_ = false;  ///< else for manual
  int tries_ = 0;               ///< of the mode asked for
  double last_try_ = 0.0;       ///< [s]
};

/// "COMPLETE_MANUAL" for Chassis::COMPLETE_MANUAL.
std::string nameOfMode(std::uint8_t mode);

}  // namespace external_command
