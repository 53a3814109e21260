// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/dedicated_lane.h"

#include <boost/make_shared.hpp>
#include <chrono>
#include <deque>
#include <mutex>
#include <utility>

namespace external_command {

namespace {

using Clock = std::chrono::steady_clock;

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

/// Keeps a queue that is no longer used for some time: roscpp's network thread hands a request over by a plain pointer
/// to the queue, and may still be about to do so when the service is gone.
void retire(std::unique_ptr<ros::CallbackQueue> queue) {
  struct Retired {
    Clock::time_point at;
    std::unique_ptr<ros::CallbackQueue> queue;
  };
  static std::mutex mutex;
  static auto& all = *new std::deque<Retired>;  // never destroyed: that thread may outlive this library's objects
  const std::lock_guard<std::mutex> lock(mutex);
  const Clock::time_point now = Clock::now();
  while (!all.empty() && now - all.front().at > std::chrono::seconds(10)) all.pop_front();
  all.push_back({now, std::move(queue)});
}

}  // namespace

DedicatedLane::DedicatedLane(unsigned threads) : queue_(std::make_unique<ros::CallbackQueue>()) {
  for (unsigned i = 0; i < threads; ++i) {
    threads_.emplace_back([this] {
      while (is_running_) queue_->callOne(ros::WallDuration(kIdle));
    });
  }
}

DedicatedLane::~DedicatedLane() {
  stop();
  retire(std::move(queue_));
}

void DedicatedLane::post(std::function<void()> job) { queue_->addCallback(boost::make_shared<Job>(std::move(job))); }

void DedicatedLane::stop() {
  is_running_ = false;
  queue_->disable();  // wakes the threads that wait
  for (std::thread& thread : threads_) thread.join();
  threads_.clear();
  queue_->clear();
}

}  // namespace external_command
