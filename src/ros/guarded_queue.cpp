// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/guarded_queue.h"

#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <deque>
#include <exception>
#include <mutex>
#include <utility>

#include "external_command/core/text.h"
#include "external_command/ros/log_writer.h"

namespace external_command {

namespace {

thread_local std::uint64_t running_stamp = 0;
std::atomic<std::uint64_t> caught{0};

class GuardedCallback : public ros::CallbackInterface {
 public:
  GuardedCallback(ros::CallbackInterfacePtr callback, const std::string& queue, std::uint64_t stamp)
      : callback_(std::move(callback)), queue_(queue), stamp_(stamp) {}

  bool ready() override { return callback_->ready(); }

  CallResult call() override {
    running_stamp = stamp_;
    CallResult result = Success;
    try {
      result = callback_->call();
    } catch (const std::exception& error) {
      note(error.what());
    } catch (...) {
      note("an exception of unknown type");
    }
    running_stamp = 0;
    return result;
  }

 private:
  void note(const std::string& what) const {
    const std::uint64_t count = ++caught;
    static LogThrottle throttle(10.0);
    logLater(LogLevel::kError, throttle,
             text("a callback of ", queue_, " threw: ", what, "; it was broken off there (", count,
                  " such exceptions since the start)"));
  }

  const ros::CallbackInterfacePtr callback_;
  const std::string queue_;
  const std::uint64_t stamp_;
};

}  // namespace

GuardedQueue::GuardedQueue(std::string name, ros::CallbackQueueInterface* queue, Stamp stamp)
    : name_(std::move(name)), queue_(queue), stamp_(std::move(stamp)) {}

void GuardedQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner_id) {
  queue_->addCallback(boost::make_shared<GuardedCallback>(callback, name_, stamp_ ? stamp_() : 0), owner_id);
}

void GuardedQueue::removeByID(std::uint64_t owner_id) { queue_->removeByID(owner_id); }

std::uint64_t GuardedQueue::stampOfRunningCallback() { return running_stamp; }

std::uint64_t caughtExceptions() { return caught; }

void retire(std::shared_ptr<void> queue) {
  using Clock = std::chrono::steady_clock;
  struct Retired {
    Clock::time_point at;
    std::shared_ptr<void> queue;
  };
  static std::mutex mutex;
  static auto& all = *new std::deque<Retired>;  // never destroyed: that thread may outlive this library's objects
  std::deque<Retired> gone;                     // destroyed without the mutex
  const std::lock_guard<std::mutex> lock(mutex);
  const Clock::time_point now = Clock::now();
  while (!all.empty() && now - all.front().at > std::chrono::seconds(10)) {
    gone.push_back(std::move(all.front()));
    all.pop_front();
  }
  all.push_back({now, std::move(queue)});
}

}  // namespace external_command
