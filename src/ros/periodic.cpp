// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/periodic.h"

#include <algorithm>
#include <atomic>
#include <boost/chrono.hpp>
#include <boost/make_shared.hpp>
#include <boost/thread.hpp>
#include <cstdint>
#include <map>
#include <mutex>
#include <utility>

namespace external_command {

namespace {

// Boost's condition variables wait by this clock; those of older standard libraries by one that is set now and then.
using SteadyClock = boost::chrono::steady_clock;

}  // namespace

struct Periodic::Job {
  SteadyClock::duration period;
  ros::CallbackQueueInterface* queue;
  std::function<void()> call;
  Wanted wanted;
  std::atomic<bool> is_in_queue{false};  ///< or runs
  std::recursive_mutex running;          ///< held while it is called, which may stop it
  bool is_stopped = false;
  std::multimap<SteadyClock::time_point, std::shared_ptr<Job>>::iterator place{};

  std::uint64_t id() const { return reinterpret_cast<std::uint64_t>(this); }
};

class Periodic::Ticker {
 public:
  static std::shared_ptr<Ticker> acquire() {
    static std::mutex mutex;
    static std::weak_ptr<Ticker> live;
    const std::lock_guard<std::mutex> lock(mutex);
    auto ticker = live.lock();
    if (!ticker) live = ticker = std::make_shared<Ticker>();
    return ticker;
  }

  Ticker() : thread_([this] { run(); }) {}

  ~Ticker() {
    {
      const boost::lock_guard<boost::mutex> lock(mutex_);
      is_ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  void add(const std::shared_ptr<Job>& job) {
    const boost::lock_guard<boost::mutex> lock(mutex_);
    job->place = due_.emplace(SteadyClock::now() + job->period, job);
    if (job->place == due_.begin()) changed_.notify_all();
  }

  /// After this the job is not put into its queue any more.
  void remove(const Job& job) {
    const boost::lock_guard<boost::mutex> lock(mutex_);
    due_.erase(job.place);
  }

 private:
  class Tick : public ros::CallbackInterface {
   public:
    explicit Tick(std::shared_ptr<Job> job) : job_(std::move(job)) {}
    ~Tick() override { job_->is_in_queue = false; }
    CallResult call() override {
      const std::lock_guard<std::recursive_mutex> lock(job_->running);
      if (!job_->is_stopped) job_->call();
      return Success;
    }

   private:
    const std::shared_ptr<Job> job_;
  };

  void run() {
    boost::unique_lock<boost::mutex> lock(mutex_);
    while (!is_ending_) {
      if (due_.empty()) {
        changed_.wait(lock);
      } else if (const SteadyClock::time_point first = due_.begin()->first; first > SteadyClock::now()) {
        changed_.wait_until(lock, first);
      } else {
        tick();
      }
    }
  }

  void tick() {
    const SteadyClock::time_point planned = due_.begin()->first;
    const std::shared_ptr<Job> job = due_.begin()->second;
    due_.erase(due_.begin());
    job->place = due_.emplace(std::max(planned + job->period, SteadyClock::now()), job);
    if (job->wanted && !job->wanted()) return;
    if (!job->is_in_queue.exchange(true)) job->queue->addCallback(boost::make_shared<Tick>(job), job->id());
  }

  boost::mutex mutex_;
  boost::condition_variable changed_;
  std::multimap<SteadyClock::time_point, std::shared_ptr<Job>> due_;
  bool is_ending_ = false;
  boost::thread thread_;
};

Periodic::Periodic(double period, ros::CallbackQueueInterface* queue, std::function<void()> job, Wanted wanted)
    : ticker_(Ticker::acquire()), job_(std::make_shared<Job>()) {
  job_->period = boost::chrono::duration_cast<SteadyClock::duration>(boost::chrono::duration<double>(period));
  job_->queue = queue;
  job_->call = std::move(job);
  job_->wanted = std::move(wanted);
  ticker_->add(job_);
}

Periodic& Periodic::operator=(Periodic&& other) noexcept {
  stop();
  ticker_ = std::move(other.ticker_);
  job_ = std::move(other.job_);
  return *this;
}

void Periodic::stop() {
  if (!job_) return;
  ticker_->remove(*job_);
  job_->queue->removeByID(job_->id());
  {
    const std::lock_guard<std::recursive_mutex> wait(job_->running);
    job_->is_stopped = true;
  }
  job_.reset();
  ticker_.reset();
}

}  // namespace external_command
