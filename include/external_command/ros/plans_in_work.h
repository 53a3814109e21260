// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <list>
#include <mutex>

#include "external_command/core/cancel_token.h"
#include "external_command/ros/command_identity.h"

namespace external_command {

/// Plans that are being worked on, so that they can be ended: those of a processor when it goes, since who unloads it,
/// or shuts the process down, does not wait for planning budgets; that of a command when it is cancelled. Thread-safe.
class PlansInWork {
 private:
  struct Plan {
    CommandSerial command = 0;
    CancelSource source;
  };

 public:
  /// A plan is in work as long as its entry lives; the entry must not outlive the PlansInWork.
  class Entry {
   public:
    Entry(PlansInWork* plans, CommandSerial command, const CancelSource& plan);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    PlansInWork& plans_;
    std::list<Plan>::iterator position_;
  };

  /// Cancels the plan of the command, where it is in work.
  void cancel(CommandSerial command);

  /// Cancels every plan in work, and those still to come as they come.
  void cancelForGood();

  bool areCancelled() const;
  std::size_t size() const;

 private:
  mutable std::mutex mutex_;
  bool are_cancelled_ = false;
  std::list<Plan> plans_;
};

}  // namespace external_command
