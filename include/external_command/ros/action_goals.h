// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <boost/signals2/connection.hpp>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "external_command/CommandStatus.h"
#include "external_command/ros/command_identity.h"
#include "external_command/ros/executor.h"
#include "external_command/ros/process_context.h"

namespace external_command {

/// How a goal ends, in the words of actionlib.
enum class GoalEnd {
  kSucceeded,
  kAborted,
  kCanceled,  ///< PREEMPTED, or RECALLED where it had not become a command
  kRejected,  ///< it has not become a command
};

/// What a command's end means for a goal that it was the command of.
GoalEnd goalEndOf(const CommandStatus& status);

/// A goal as its client sees it.
class ClientGoal {
 public:
  virtual ~ClientGoal() = default;
  virtual void accept() = 0;
  virtual void tell(const CommandStatus& status) = 0;  ///< feedback
  virtual void end(GoalEnd end, const CommandStatus& status) = 0;
};

/// The goals of one action that have not ended: each is a command, follows its status and ends with it.
///
/// A goal is   waiting    from add() on
///             begun      from begin() on: it is being carried out as a request
///             a command  from admitted() on: ACTIVE
///             answered   from answered() on; it ends when its command has ended, too
///
/// All that clients are told is told on executor(), and nothing in a goal's first 0.15 s: actionlib's
/// SimpleActionClient misses for good what it hears before its send_goal() has returned. Thread-safe.
class ActionGoals {
 public:
  class Goal;
  using GoalPtr = std::shared_ptr<Goal>;

  explicit ActionGoals(ProcessContext& context, const std::string& name);

  /// Ends the goals that are left; their commands go on.
  ~ActionGoals();

  /// For other short callbacks of the action.
  Executor& executor() { return line_->executor; }

  enum class Accept {
    kAsCommand,  ///< when it becomes a command; a goal that becomes none is rejected
    kAtOnce
  };

  /// @param id  the goal's, of actionlib.
  GoalPtr add(const std::string& id, std::unique_ptr<ClientGoal> client, Accept accept = Accept::kAsCommand);

  /// False where it was cancelled: it must not be carried out.
  bool begin(const GoalPtr& goal);

  /// @throws Cancelled  it was cancelled.
  void admitted(const GoalPtr& goal, CommandSerial serial);

  void answered(const GoalPtr& goal, const CommandStatus& status);

  /// Nobody wants it any more: a command is cancelled, before that it is not carried out.
  /// @param by  who cancels it, for the status' message.
  void cancel(const std::string& id, const std::string& by);

  /// Whether there are goals that have not ended.
  bool areThere() const { return line_->goals > 0; }

  /// Tells what was kept back; to be called on executor() every 0.1 s while there are goals.
  void look();

  /// Tells every client how its command fares; to be called on executor() a few times per second.
  void tick();

 private:
  /// Outlives this object for whoever is telling of a change just then.
  struct Line {
    explicit Line(const std::string& name) : executor(ExecutorOptions{name}) {}
    std::atomic<int> goals{0};
    Executor executor;
  };

  // All on the executor.
  void cancelNow(const std::string& id, const std::string& by);
  void follow(const GoalPtr& goal, CommandSerial serial);
  void noteChange(CommandSerial serial, const CommandStatus& status);
  void note(const GoalPtr& goal, const CommandStatus& status);
  void update(const GoalPtr& goal);
  void finish(const GoalPtr& goal);
  void endAll();
  CommandStatus statusOf(CommandSerial serial) const;

  ProcessContext& context_;
  const std::shared_ptr<Line> line_;
  std::map<std::string, GoalPtr> goals_;  ///< of the executor
  boost::signals2::scoped_connection changes_;
};

}  // namespace external_command
