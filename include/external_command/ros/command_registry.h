// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>

#include "external_command/CommandStatus.h"
#include "external_command/core/error.h"

namespace external_command {

/// The status of the newest 1,000 commands of every processor in one namespace. Thread-safe; every call is O(1) or
/// close to it, and calls nothing but the listener while it holds its mutex.
class CommandRegistry {
 public:
  static constexpr std::size_t kCapacity = 1000;

  /// Told every change of any command's status, in order.
  using Listener = std::function<void(const CommandStatus&)>;

  explicit CommandRegistry(Listener listener);

  struct Admission {
    std::int64_t command_id = 0;
    std::optional<CommandStatus> running;  ///< set where the request is a retry: its present status
  };

  /// Lets a checked request in and makes it RUNNING.
  /// @param wanted_id  0 or below: a fresh id is given.
  /// @param digest     of the request but for stamp and id; an equal one under a running id is a retry.
  /// @throws DuplicateId  another command with this id is still running.
  Admission admit(std::int64_t wanted_id, const std::string& processor, std::uint64_t digest);

  /// Answers a request that failed. Recorded under its id, except while another command runs under it.
  /// @return `status`, with a fresh id where it had none.
  CommandStatus refuse(CommandStatus status, const std::string& processor);

  /// From now on the vehicle's reports count for this command.
  void markSent(std::int64_t command_id, const std::string& message);

  /// Ends a running command, or changes the message of it (status RUNNING), which reports then leave as it is. The
  /// first end counts: false where the command is not running (any more).
  bool update(const CommandStatus& status);

  /// A report of planner or chassis about a command of `processor`. Ignored for others, and where it is older than the
  /// command.
  void report(const CommandStatus& status, const std::string& processor);

  /// Notes in the message of each command sent longer than `limit` [s] ago that nothing was reported about it since.
  void noteSilence(double limit);

  /// UNKNOWN for an id never seen, or long forgotten.
  CommandStatus find(std::int64_t command_id) const;

 private:
  struct Record {
    CommandStatus status;
    std::string processor;
    std::uint64_t digest = 0;
    bool was_sent = false;
    bool is_silent = false;
    bool has_own_message = false;  ///< its processor says more than the vehicle's reports
    ros::Time sent_at;             ///< to compare with the stamps of reports
    ros::WallTime last_report;     ///< or when it was sent
  };

  Record& add(std::int64_t command_id, const std::string& processor);
  void forgetOldest();
  void change(Record* record, const CommandStatus& status);

  mutable std::mutex mutex_;
  const Listener listener_;
  std::int64_t next_id_;
  std::unordered_map<std::int64_t, Record> records_;
  std::deque<std::int64_t> order_;  ///< ids, the oldest first
};

}  // namespace external_command
