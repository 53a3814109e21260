// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace external_command {

/// The action beside a command service, as the service sees it: open from its making on.
class CommandAction {
 public:
  CommandAction() = default;
  CommandAction(const CommandAction&) = delete;
  CommandAction& operator=(const CommandAction&) = delete;
  virtual ~CommandAction() = default;  ///< ends the goals that are left

  /// Takes no goal any more; those taken go on. Idempotent.
  virtual void stopTaking() = 0;
};

}  // namespace external_command
