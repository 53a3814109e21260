// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <list>
#include <mutex>

#include "external_command/core/cancel_token.h"

namespace external_command {

/// The plans of a processor that are being worked on, so that they end when it goes: who unloads it, or shuts the
/// process down, does not wait for planning budgets. Thread-safe.
class PlansInWork {
 public:
  /// A plan is in work as long as its entry lives; the entry must not outlive the PlansInWork.
  class Entry {
   public:
    Entry(PlansInWork* plans, const CancelSource& plan);
    ~Entry();
    Entry(const Entry&) = delete;
    Entry& operator=(const Entry&) = delete;

   private:
    PlansInWork& plans_;
    std::list<CancelSource>::iterator position_;
  };

  /// Cancels every plan in work, and those still to come as they come.
  void cancelForGood();

  bool areCancelled() const;
  std::size_t size() const;

 private:
  mutable std::mutex mutex_;
  bool are_cancelled_ = false;
  std::list<CancelSource> plans_;
};

}  // namespace external_command
