// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/executor.h"

#include <boost/make_shared.hpp>
#include <chrono>
#include <thread>
#include <utility>

#include "thread_crew.h"
#include "thread_priority.h"

namespace external_command {

namespace {

constexpr std::chrono::milliseconds kBusy(1);  // after which a subscriber that runs already is tried again

class Job : public ros::CallbackInterface {
 public:
  explicit Job(std::function<void()> job) : job_(std::move(job)) {}
  CallResult call() override {
    job_();
    return Success;
  }

 private:
  const std::function<void()> job_;
};

void take(ExecutorPriority priority) {
  if (priority == ExecutorPriority::kBackground) lowerThreadPriority();
  if (priority == ExecutorPriority::kUrgent) raiseThreadPriority();
}

}  // namespace

struct Executor::Queues : public ros::CallbackQueueInterface {
  explicit Queues(const ExecutorOptions& options)
      : crew({options.threads, [priority = options.priority] { take(priority); }, [this] { work(); }}),
        guarded(options.name, this, options.stamp) {}

  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner_id) override {
    queue.addCallback(callback, owner_id);
    crew.call();
  }

  void removeByID(std::uint64_t owner_id) override { queue.removeByID(owner_id); }

  void work() {
    while (queue.callOne() == ros::CallbackQueue::TryAgain) std::this_thread::sleep_for(kBusy);
  }

  ros::CallbackQueue queue;
  ThreadCrew crew;
  GuardedQueue guarded;
};

Executor::Executor(ExecutorOptions options) : queues_(std::make_shared<Queues>(options)) {}

Executor::~Executor() {
  stop();
  retire(queues_);
}

ros::CallbackQueueInterface* Executor::queue() { return &queues_->guarded; }

void Executor::post(std::function<void()> job) {
  queues_->guarded.addCallback(boost::make_shared<Job>(std::move(job)), 0);
}

Periodic Executor::every(double period, std::function<void()> job, Periodic::Wanted wanted) {
  return {period, queue(), std::move(job), std::move(wanted)};
}

void Executor::stop() {
  queues_->queue.disable();
  queues_->crew.stop();
  queues_->queue.clear();
}

}  // namespace external_command
