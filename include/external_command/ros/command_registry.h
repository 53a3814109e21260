// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "external_command/CommandStatus.h"
#include "external_command/core/error.h"
#include "external_command/ros/command_identity.h"

namespace external_command {

/// A status of the command that has the serial, whatever id it goes by.
struct StatusChange {
  CommandSerial serial = 0;
  CommandStatus status;
};

/// Who takes a command.
struct CommandOwner {
  std::string processor;  ///< its nodelet's name; only reports to it count
  std::string service;    ///< its name without a namespace; CommandStatus::service
};

/// How far a motion command has come.
struct MotionProgress {
  double distance_left = 0.0;  ///< [m]
  double share_done = 0.0;     ///< in [0, 1]
  double time_left = 0.0;      ///< [s]
};

/// That nothing was reported about a command for more than `limit` [s].
std::string silenceWords(double limit);

/// Which of the vehicle's reports count.
struct ReportRules {
  double clock_skew = 0.5;  ///< a report stamped this much before its command was sent still counts [s]
  bool may_finish = true;   ///< false: a report FINISHED ends no command, the vehicle's pose does
};

/// The status of every running command of one namespace, and of the newest 1,000 that have ended. Thread-safe; every
/// call is O(log n) or close to it, and calls nothing but the listener while it holds its mutex.
///
/// A command is   planned   from its admission on
///                sent      from markSent() on: the vehicle's reports count
///                ended     by its processor, a report, or one that takes its place; the first end counts
class CommandRegistry {
 public:
  static constexpr std::size_t kCapacity = 1000;  ///< of ended commands

  /// Told every change of any command's status, in order.
  using Listener = std::function<void(CommandSerial, const CommandStatus&)>;

  explicit CommandRegistry(Listener listener, ReportRules rules = {});

  struct Admission {
    AdmittedCommand command;               ///< its arrival is not filled in
    std::optional<CommandStatus> running;  ///< set where the request is a retry: its present status
    std::string note;                      ///< set where it got another id than it wanted: why
  };

  /// Lets a checked request in and makes it RUNNING.
  /// @param wanted_id  0 or below: a fresh id is given.
  /// @param digest     of the request but for stamp and id; an equal one under a running id is a retry.
  /// @throws DuplicateId  another command with this id is still running.
  Admission admit(std::int64_t wanted_id, const CommandOwner& owner, std::uint64_t digest);

  /// The same for a request that is carried out whatever its id: under a known one it gets a fresh id.
  Admission admitAlways(std::int64_t wanted_id, const CommandOwner& owner);

  /// Answers a request that failed. Recorded under its id, except while another command runs under it.
  /// @return `status`, with a fresh id where it had none.
  CommandStatus refuse(CommandStatus status, const CommandOwner& owner);

  /// From now on the vehicle's reports count for this command.
  void markSent(CommandSerial serial, const std::string& message);

  /// What the caller of a running command was told, unless more is known of it by now.
  void noteAnswer(CommandSerial serial, const std::string& message);

  /// How far a command that was sent has come; nullopt where that is not known. No news for the listener.
  void noteProgress(CommandSerial serial, const std::optional<MotionProgress>& progress);

  /// Ends a running command, or tells how far it has come (status RUNNING), which reports then leave as it is. The
  /// first end counts: false where the command is not running (any more).
  bool update(const StatusChange& change);

  /// A report of planner or chassis about a command of `processor`. Those of others are ignored, and those that are
  /// older than the command.
  /// @return  false where its status is none a report can have: the report counts for nothing.
  bool report(const CommandStatus& status, const std::string& processor);

  /// Notes beside the message of each command sent longer than `limit` [s] ago that nothing was reported about it
  /// since.
  void noteSilence(double limit);

  /// The last that came; nullopt where none did.
  std::optional<CommandStatus> newest() const;

  /// Of all running commands, in the order of their admission.
  std::vector<CommandStatus> running() const;

  /// UNKNOWN for an id never seen, or long forgotten.
  CommandStatus find(std::int64_t command_id) const;

  /// nullopt where the command was forgotten, or its id was given to another one.
  std::optional<CommandStatus> statusOf(CommandSerial serial) const;
  bool isRunning(CommandSerial serial) const;

  /// @throws Cancelled  the command is not running (any more): it was cancelled.
  void requireRunning(const AdmittedCommand& command) const;

  /// Of the newest command by that id; nullopt where none is known.
  std::optional<CommandSerial> serialOf(std::int64_t command_id) const;

  /// Seconds since anything was reported about a sent command, or since it was sent.
  double silenceOf(CommandSerial serial) const;

 private:
  enum class State { kPlanned, kSent, kEnded };

  struct Record {
    explicit Record(CommandOwner taken_by) : owner(std::move(taken_by)) {}

    CommandStatus status;  ///< its message is composed of the three below
    std::string said;      ///< by its processor when it was sent, then by the vehicle's reports
    std::string progress;  ///< its processor's own words on how far it has come; they count more
    std::string silence;   ///< set while the planner says nothing
    std::optional<MotionProgress> driven;
    const CommandOwner owner;
    std::uint64_t digest = 0;
    State state = State::kPlanned;
    double skew = 0.0;            ///< by which a report may seem older than the command [s]
    ros::Time sent_at;            ///< to compare with the stamps of reports
    ros::SteadyTime last_report;  ///< or when it was sent
  };

  Record* running(CommandSerial serial);
  const Record* byId(std::int64_t command_id) const;
  Admission letIn(std::int64_t wanted_id, const CommandOwner& owner, std::uint64_t digest);
  AdmittedCommand add(std::int64_t command_id, const CommandOwner& owner, std::uint64_t digest);
  void say(CommandSerial serial, Record* record);
  void change(CommandSerial serial, Record* record, const CommandStatus& status);
  void forgetOldest();

  mutable std::mutex mutex_;
  const Listener listener_;
  const ReportRules rules_;
  std::int64_t next_id_;
  CommandSerial last_serial_ = 0;
  std::map<CommandSerial, Record> records_;
  std::unordered_map<std::int64_t, CommandSerial> serials_;  ///< of the newest command by each id
  std::deque<CommandSerial> ended_;                          ///< in the order of their ends
};

}  // namespace external_command
