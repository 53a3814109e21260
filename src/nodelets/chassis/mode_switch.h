// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace external_command {

struct ModeSwitchParams {
  int tries = 3;          ///< how often a mode is asked for
  double interval = 0.5;  ///< between two tries, and after the last [s]
};

/// What the chassis reported last.
struct ReportedMode {
  std::uint8_t mode = 0;  ///< one of Chassis's constants
  double time = 0.0;      ///< when it was reported [s]
};

/// Decides what to send to bring the chassis into a driving mode, from what it reports. Only a report newer than what
/// was sent shows that it was carried out.
///
///   to manual:  ask for manual until the chassis reports it
///   to auto:    the same, then ask for auto until the chassis reports that; what it reports first may save a step
class ModeSwitch {
 public:
  enum class Target { kManual, kAuto };
  enum class Step { kWait, kSendManual, kSendAuto, kDone, kFailed };

  /// @param is_settled  false where the chassis may still be carrying out an earlier switch: nothing is saved then.
  /// @param now         when it was asked for [s], of any steady clock.
  ModeSwitch(Target target, const ModeSwitchParams& params, bool is_settled, double now);

  Target target() const { return target_; }

  /// What is to be done now. To be called with every report of the chassis and, with its last one, at short intervals.
  /// @param reported  nullopt where the chassis was not heard of lately.
  Step next(const std::optional<ReportedMode>& reported, double now);

  /// What it waits for, or why it failed.
  std::string describe(const std::optional<ReportedMode>& reported) const;

 private:
  std::uint8_t wantedMode() const;
  std::optional<Step> firstStep(const std::optional<ReportedMode>& reported, double now);

  const Target target_;
  const ModeSwitchParams params_;
  const double asked_at_;       ///< [s]
  bool looks_first_;            ///< at what the chassis reports, before anything is sent
  bool asks_for_auto_ = false;  ///< else for manual
  int tries_ = 0;               ///< of the mode asked for
  double first_try_ = 0.0;      ///< [s]
  double last_try_ = 0.0;       ///< [s]
};

/// "COMPLETE_MANUAL" for Chassis::COMPLETE_MANUAL.
std::string nameOfMode(std::uint8_t mode);

}  // namespace external_command
