// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

namespace external_command {

/// Threads that do pieces of work as these come, as many at once as there are threads. They are made when they are
/// needed, so that a burst finds its threads and a quiet time has few: each keeps a stack and memory of the allocator.
/// Who has worked last works next, and who had nothing to do for some time ends. Thread-safe.
class ThreadCrew {
 public:
  struct Options {
    unsigned most = 1;                      ///< threads
    std::function<void()> begin;            ///< called in each new thread
    std::function<void()> work;             ///< does one piece of work; must not throw
    std::chrono::milliseconds idle{10000};  ///< after which a thread ends, unless it is one of two
  };

  /// Makes the first thread. @throws std::system_error
  explicit ThreadCrew(Options options);
  ~ThreadCrew();
  ThreadCrew(const ThreadCrew&) = delete;
  ThreadCrew& operator=(const ThreadCrew&) = delete;

  /// There is one more piece of work. Never makes a thread: who takes work and leaves none idle does, so that new ones
  /// have the priority of the crew, not of who calls.
  void call();

  /// Waits for what is in work; calls that are left are dropped. Idempotent. Not from a thread of the crew.
  void stop();

 private:
  /// Where one thread waits.
  struct Seat {
    std::condition_variable called;
    bool is_called = false;
  };

  using Threads = std::list<std::thread>;

  void add();
  void run(Threads::iterator self);
  bool waitForCall(std::unique_lock<std::mutex>* lock);

  const Options options_;
  std::mutex mutex_;
  std::vector<Seat*> idle_;  ///< the last one waits for the shortest time
  unsigned calls_ = 0;       ///< that nobody has taken yet
  bool is_stopping_ = false;
  Threads threads_, ended_;
};

}  // namespace external_command
