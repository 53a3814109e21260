// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "external_command/Chassis.h"
#include "mode_switch.h"

namespace external_command {

struct HeardChassisParams {
  std::string topic;              ///< as it is resolved
  double max_age = 1.0;           ///< an older report counts as none [s]
  std::string max_age_name;       ///< of that parameter, "~max_chassis_age"
  double max_future_stamp = 0.5;  ///< a report stamped further ahead of now counts for nothing [s]
};

/// What was heard of the chassis last. Not thread-safe.
class HeardChassis {
 public:
  explicit HeardChassis(HeardChassisParams params) : params_(std::move(params)) {}

  /// False where the report counts for nothing: its stamp lies in the future.
  bool take(const Chassis& chassis);

  /// The driving mode of the last report; nullopt where that is too old, or none came.
  std::optional<ReportedMode> freshMode() const;

  /// @throws NotReady  there is none; the text tells why.
  void require() const;

  /// How it stands, as Conditions::Check has it. @throws NotReady
  std::string words() const;

 private:
  const HeardChassisParams params_;
  std::optional<ReportedMode> reported_;
  std::string odd_stamp_;  ///< why the newest report does not count; empty where it does
};

}  // namespace external_command
