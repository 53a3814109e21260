// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/dedicated_lane.h"

#include <boost/make_shared.hpp>
#include <utility>

namespace external_command {

namespace {

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

}  // namespace

DedicatedLane::DedicatedLane(unsigned threads) : spinner_(threads, &queue_) { spinner_.start(); }

void DedicatedLane::post(std::function<void()> job) { queue_.addCallback(boost::make_shared<Job>(std::move(job))); }

void DedicatedLane::stop() {
  queue_.disable();
  spinner_.stop();
  queue_.clear();
}

}  // namespace external_command
