// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "external_command/core/cancel_token.h"

namespace external_command {

/// Decides which motion command may move the vehicle. One mutex, held for a compare and one publish, never while
/// planning. Thread-safe.
///
///   arrive()  when the request comes        -> what was stopped later than this stops it too
///   begin()   before the long planning      -> cancels the planning of an older command
///   commit()  to send it                    -> refused where a stop or a newer command came in between
class CommandGate {
 public:
  /// The moment a request came in.
  class Arrival {
    friend class CommandGate;
    std::uint64_t stop_epoch_ = 0;
  };

  /// The right to plan for one command, and to send it once.
  class Ticket {
   public:
    CancelToken cancelToken() const { return planning_.token(); }

    /// Raises the token; for who has another reason to end the planning than the gate has.
    const CancelSource& cancelSource() const { return planning_; }

   private:
    friend class CommandGate;
    std::int64_t command_id_ = 0;
    std::uint64_t epoch_ = 0;
    CancelSource planning_;
  };

  Arrival arrive() const;

  /// Cancels the planning in progress of an older command, if there is one.
  /// @throws Cancelled  a stop came in since `arrival`.
  Ticket begin(std::int64_t command_id, const Arrival& arrival);

  /// @throws Cancelled   a stop came in since begin().
  /// @throws Superseded  a newer command began since.
  void requireCurrent(const Ticket& ticket) const;

  /// Calls `publish` and makes the ticket's command the one that moves the vehicle.
  /// @return  the command it replaces, if any.
  /// @throws  as requireCurrent(); nothing is published.
  std::optional<std::int64_t> commit(const Ticket& ticket, const std::function<void()>& publish);

  /// Cancels the planning in progress; nothing that arrived before is sent any more. Does not wait for it.
  /// `publish` (may be empty) is called while the gate is held, so that it leaves after every commit before it and
  /// before every one after it.
  /// @return  as lastSent(), at that moment.
  std::optional<std::int64_t> stop(const std::function<void()>& publish);

  /// The command sent last, if any was.
  std::optional<std::int64_t> lastSent() const;

 private:
  void requireCurrentLocked(const Ticket& ticket) const;

  mutable std::mutex mutex_;
  std::uint64_t stop_epoch_ = 0;  ///< epochs up to this one were stopped
  std::uint64_t epoch_ = 0;       ///< of the newest ticket
  std::int64_t newest_id_ = 0;    ///< of the newest ticket
  CancelSource planning_;         ///< raises the newest ticket's token
  std::optional<std::int64_t> last_sent_;
};

}  // namespace external_command
