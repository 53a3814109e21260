// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/action_goals.h"

#include <chrono>
#include <future>
#include <utility>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kQuiet(150);

CommandStatus cancelledEarly(const std::string& by) {
  return makeStatus(0, CommandStatus::ERROR, ErrorCode::kCancelled,
                    text("cancelled by ", by, " before it became a command; nothing was sent"));
}

}  // namespace

class ActionGoals::Goal {
 public:
  enum class Stage { kWaiting, kBegun, kWithdrawn };

  Goal(std::string goal_id, std::unique_ptr<ClientGoal> of_client, bool accepted_at_once)
      : id(std::move(goal_id)), client(std::move(of_client)), is_to_be_accepted(accepted_at_once) {}

  const std::string id;
  std::atomic<Stage> stage{Stage::kWaiting};
  std::atomic<bool> is_cancelled{false};

  // Of the executor.
  const std::unique_ptr<ClientGoal> client;
  const Clock::time_point told_from = Clock::now() + kQuiet;
  std::string cancelled_by;
  std::optional<CommandSerial> serial;
  std::optional<CommandStatus> news;  ///< not told yet
  std::optional<CommandStatus> end;   ///< of its command, or of the request that became none
  bool is_answered = false;           ///< only then the report of a request is there
  bool is_to_be_accepted;
  bool is_accepted = false;
};

/// Who is told ABORTED tries again, as many programs do. What somebody has stopped, or replaced, is not to be.
GoalEnd goalEndOf(const CommandStatus& status) {
  if (status.status == CommandStatus::FINISHED) return GoalEnd::kSucceeded;
  const bool is_unwanted =
      status.error_code == CommandStatus::CANCELLED || status.error_code == CommandStatus::SUPERSEDED;
  return is_unwanted ? GoalEnd::kCanceled : GoalEnd::kAborted;
}

ActionGoals::ActionGoals(ProcessContext& context, const std::string& name)
    : context_(context), line_(std::make_shared<Line>("the goals of " + name)) {
  using Slot = ProcessContext::StatusChanges::slot_type;
  // The registry calls it while it is held: it must not wait.
  const auto on_change = [this, line = line_.get()](CommandSerial serial, const CommandStatus& status) {
    if (line->goals > 0) line->executor.post([this, serial, status] { noteChange(serial, status); });
  };
  changes_ = context.statusChanges().connect(Slot(on_change).track_foreign(line_));
}

ActionGoals::~ActionGoals() {
  changes_.disconnect();
  std::promise<void> done;
  line_->executor.post([&] {
    endAll();
    done.set_value();
  });
  done.get_future().wait();
  line_->executor.stop();
}

ActionGoals::GoalPtr ActionGoals::add(const std::string& id, std::unique_ptr<ClientGoal> client, Accept accept) {
  const auto goal = std::make_shared<Goal>(id, std::move(client), accept == Accept::kAtOnce);
  ++line_->goals;
  line_->executor.post([this, goal] { goals_[goal->id] = goal; });
  return goal;
}

bool ActionGoals::begin(const GoalPtr& goal) {
  Goal::Stage waiting = Goal::Stage::kWaiting;
  return goal->stage.compare_exchange_strong(waiting, Goal::Stage::kBegun);
}

void ActionGoals::admitted(const GoalPtr& goal, CommandSerial serial) {
  if (goal->is_cancelled) throw Cancelled("its goal was cancelled before it became a command; nothing was sent");
  line_->executor.post([this, goal, serial] { follow(goal, serial); });
}

void ActionGoals::answered(const GoalPtr& goal, const CommandStatus& status) {
  line_->executor.post([this, goal, status] {
    goal->is_answered = true;
    if (hasEnded(status) && !goal->end) goal->end = status;
    update(goal);
  });
}

void ActionGoals::cancel(const std::string& id, const std::string& by) {
  line_->executor.post([this, id, by] { cancelNow(id, by); });
}

void ActionGoals::cancelNow(const std::string& id, const std::string& by) {
  const auto found = goals_.find(id);
  if (found == goals_.end()) return;  // it has just ended
  const GoalPtr goal = found->second;
  goal->cancelled_by = by;
  goal->is_cancelled = true;
  Goal::Stage waiting = Goal::Stage::kWaiting;
  if (goal->stage.compare_exchange_strong(waiting, Goal::Stage::kWithdrawn)) {
    goal->end = cancelledEarly(by);
    goal->is_answered = true;
    update(goal);
  } else if (goal->serial) {
    context_.cancel(*goal->serial, by);
  }
}

void ActionGoals::follow(const GoalPtr& goal, CommandSerial serial) {
  goal->serial = serial;
  goal->is_to_be_accepted = true;
  if (goal->is_cancelled) context_.cancel(serial, goal->cancelled_by);
  note(goal, statusOf(serial));
}

void ActionGoals::noteChange(CommandSerial serial, const CommandStatus& status) {
  std::vector<GoalPtr> concerned;  // two where one is a retry of the other
  for (const auto& [id, goal] : goals_) {
    if (goal->serial == serial) concerned.push_back(goal);
  }
  if (concerned.empty()) return;
  // While this waited for its turn, a tick may have told what is newer: progress must not seem to go back.
  const std::optional<CommandStatus> newest = hasEnded(status) ? status : context_.registry().statusOf(serial);
  if (!newest) return;  // forgotten since: how it ended is the next in this line
  for (const GoalPtr& goal : concerned) note(goal, *newest);
}

void ActionGoals::note(const GoalPtr& goal, const CommandStatus& status) {
  if (goal->end) return;
  (hasEnded(status) ? goal->end : goal->news) = status;
  update(goal);
}

void ActionGoals::update(const GoalPtr& goal) {
  if (Clock::now() < goal->told_from) return;
  if (goal->is_to_be_accepted && !goal->is_accepted) {
    goal->is_accepted = true;
    goal->client->accept();
  }
  if (goal->is_answered && goal->end) return finish(goal);
  if (goal->news && !goal->end) goal->client->tell(*goal->news);
  goal->news.reset();
}

void ActionGoals::finish(const GoalPtr& goal) {
  const auto found = goals_.find(goal->id);
  if (found == goals_.end() || found->second != goal) return;
  goals_.erase(found);
  --line_->goals;
  const GoalEnd end = goalEndOf(*goal->end);
  const bool is_rejected = !goal->is_accepted && end != GoalEnd::kCanceled;
  goal->client->end(is_rejected ? GoalEnd::kRejected : end, *goal->end);
}

void ActionGoals::look() {
  const std::map<std::string, GoalPtr> goals = goals_;
  for (const auto& [id, goal] : goals) update(goal);
}

void ActionGoals::tick() {
  const std::map<std::string, GoalPtr> goals = goals_;
  for (const auto& [id, goal] : goals) {
    if (goal->serial) note(goal, statusOf(*goal->serial));
  }
}

void ActionGoals::endAll() {
  const std::map<std::string, GoalPtr> goals = goals_;
  for (const auto& [id, goal] : goals) {
    if (!goal->end)
      goal->end = goal->serial ? statusOf(*goal->serial) : cancelledEarly("the unloading of its processor");
    if (!hasEnded(*goal->end)) {
      goal->end->message = "its processor was unloaded; the command goes on: " + goal->end->message;
    }
    if (goal->is_to_be_accepted && !goal->is_accepted) goal->client->accept();
    goal->is_accepted = goal->is_to_be_accepted;
    finish(goal);
  }
}

CommandStatus ActionGoals::statusOf(CommandSerial serial) const {
  const std::optional<CommandStatus> status = context_.registry().statusOf(serial);
  if (status) return *status;
  return makeStatus(0, CommandStatus::UNKNOWN, ErrorCode::kUnknownId, "the command ended, and was forgotten");
}

}  // namespace external_command
