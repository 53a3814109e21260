// SPDX-License-Identifier: Apache-2.0
#include "thread_crew.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace external_command {

namespace {

constexpr std::size_t kKept = 2;  // threads that stay: one in work, and the next

}  // namespace

ThreadCrew::ThreadCrew(Options options) : options_(std::move(options)) {
  const std::lock_guard<std::mutex> lock(mutex_);
  add();
}

ThreadCrew::~ThreadCrew() { stop(); }

void ThreadCrew::call() {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (is_stopping_) return;
  ++calls_;
  if (idle_.empty()) return;
  Seat* const last = idle_.back();
  idle_.pop_back();
  last->is_called = true;
  last->called.notify_one();
}

void ThreadCrew::stop() {
  std::unique_lock<std::mutex> lock(mutex_);
  is_stopping_ = true;
  for (Seat* const seat : idle_) seat->called.notify_one();
  idle_.clear();
  lock.unlock();
  for (Threads* const threads : {&threads_, &ended_}) {
    for (std::thread& thread : *threads) thread.join();
    threads->clear();
  }
}

/// With the mutex held.
void ThreadCrew::add() {
  for (std::thread& thread : ended_) thread.join();
  ended_.clear();
  const auto self = threads_.emplace(threads_.end());
  try {
    *self = std::thread([this, self] { run(self); });
  } catch (...) {
    threads_.erase(self);
    throw;
  }
}

void ThreadCrew::run(Threads::iterator self) {
  options_.begin();
  std::unique_lock<std::mutex> lock(mutex_);
  while (!is_stopping_) {
    if (calls_ == 0 && !waitForCall(&lock)) break;
    if (is_stopping_ || calls_ == 0) continue;
    --calls_;
    try {
      if (idle_.empty() && threads_.size() < options_.most) add();
    } catch (const std::system_error&) {  // there are as many as the system lets this process have
    }
    lock.unlock();
    options_.work();
    lock.lock();
  }
  if (!is_stopping_) ended_.splice(ended_.end(), threads_, self);
}

/// @return false where the thread is needed no more.
bool ThreadCrew::waitForCall(std::unique_lock<std::mutex>* lock) {
  Seat seat;
  idle_.push_back(&seat);
  const auto has_reason = [&] { return seat.is_called || is_stopping_; };
  while (!seat.called.wait_for(*lock, options_.idle, has_reason)) {
    if (threads_.size() <= kKept || idle_.size() < 2) continue;
    idle_.erase(std::find(idle_.begin(), idle_.end(), &seat));
    return false;
  }
  return true;
}

}  // namespace external_command
