// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/dedicated_lane.h"

#include <boost/make_shared.hpp>
#include <utility>

#include "thread_priority.h"

namespace external_command {

namespace {

constexpr double kIdle = 1.0;  // a thread without work looks after its lane that often [s]

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

void take(LanePriority priority) {
  if (priority == LanePriority::kBackground) lowerThreadPriority();
  if (priority == LanePriority::kUrgent) raiseThreadPriority();
}

}  // namespace

struct DedicatedLane::Queues {
  explicit Queues(const LaneOptions& options) : guarded(options.name, &queue, options.stamp) {}

  ros::CallbackQueue queue;
  GuardedQueue guarded;
};

DedicatedLane::DedicatedLane(LaneOptions options) : queues_(std::make_shared<Queues>(options)) {
  for (unsigned i = 0; i < options.threads; ++i) {
    threads_.emplace_back([this, priority = options.priority] {
      take(priority);
      while (is_running_) queues_->queue.callOne(ros::WallDuration(kIdle));
    });
  }
}

DedicatedLane::~DedicatedLane() {
  stop();
  retire(queues_);
}

ros::CallbackQueueInterface* DedicatedLane::queue() { return &queues_->guarded; }

void DedicatedLane::post(std::function<void()> job) {
  queues_->guarded.addCallback(boost::make_shared<Job>(std::move(job)), 0);
}

void DedicatedLane::stop() {
  is_running_ = false;
  queues_->queue.disable();  // wakes the threads that wait
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  queues_->queue.clear();
}

}  // namespace external_command
