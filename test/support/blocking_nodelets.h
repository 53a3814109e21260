// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nodelet/nodelet.h>
#include <ros/callback_queue.h>

#include <atomic>
#include <boost/make_shared.hpp>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "external_command/LaneFollow.h"
#include "external_command/PathFollow.h"
#include "external_command/ros/motion_command_processor.h"

namespace external_command {

/// Keeps those who pass it until the test opens it, or has failed without: after 60 s. Thread-safe.
class TestGate {
 public:
  /// Returns once the gate is open, or `gives_up()` is true.
  void pass(const std::function<bool()>& gives_up) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    const auto isOver = [&] { return gives_up() || std::chrono::steady_clock::now() > end; };
    std::unique_lock<std::mutex> lock(mutex_);
    ++entered_;
    changed_.notify_all();
    // What makes it give up notifies nobody, so it is looked at often.
    while (!is_open_ && !isOver()) changed_.wait_for(lock, std::chrono::milliseconds(1));
    ++left_;
    changed_.notify_all();
  }

  void open() {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }

  /// False where fewer than `count` have come within 10 s.
  bool waitForEntered(unsigned count) {
    return waitFor([this, count] { return entered_ >= count; });
  }
  bool waitForLeft(unsigned count) {
    return waitFor([this, count] { return left_ >= count; });
  }

  /// Who waits here has been cancelled, whether or not it gives up for that. To be called by its gives_up().
  void noteCancel() {
    is_cancelled_ = true;
    changed_.notify_all();
  }
  bool waitForCancel() {
    return waitFor([this] { return is_cancelled_; });
  }

  unsigned entered() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return entered_;
  }

 private:
  bool waitFor(const std::function<bool()>& condition) {
    std::unique_lock<std::mutex> lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(10), condition);
  }

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  unsigned entered_ = 0, left_ = 0;
  bool is_open_ = false, is_cancelled_ = false;
};

/// Occupies the worker threads of the manager that it is loaded into.
class WorkerBlocker : public nodelet::Nodelet {
 public:
  /// As many jobs as that, each of which passes `gate`.
  void block(const std::shared_ptr<TestGate>& gate, unsigned jobs) {
    for (unsigned i = 0; i < jobs; ++i) getMTCallbackQueue().addCallback(boost::make_shared<Job>(gate));
  }

 private:
  class Job : public ros::CallbackInterface {
   public:
    explicit Job(std::shared_ptr<TestGate> gate) : gate_(std::move(gate)) {}
    CallResult call() override {
      gate_->pass([] { return false; });
      return Success;
    }

   private:
    const std::shared_ptr<TestGate> gate_;
  };

  void onInit() override {}
};

/// A motion command whose planning lasts until the test opens its gate.
template <class Service>
class BlockingProcessor : public MotionCommandProcessor<Service> {
 public:
  using typename MotionCommandProcessor<Service>::Command;

  explicit BlockingProcessor(const std::string& service) : MotionCommandProcessor<Service>(service) {}
  ~BlockingProcessor() override { this->stopServing(); }

  /// The gate of the plans that begin from now on.
  /// @param polls_cancel  false: a planner that does not notice that it is cancelled.
  std::shared_ptr<TestGate> holdPlans(bool polls_cancel) {
    const std::lock_guard<std::mutex> lock(mutex_);
    gate_ = std::make_shared<TestGate>();
    polls_cancel_ = polls_cancel;
    return gate_;
  }

  /// Whether what the gate holds is the checking of a command, before it ends an older one; else its planning.
  void setHoldsChecks(bool holds_checks) { holds_checks_ = holds_checks; }

  /// Whether there is a route to where the commands lead from now on.
  void setHasRoute(bool has_route) { has_route_ = has_route; }

  bool seesVehicleAt(double x) const {
    try {
      return std::abs(this->context().vehiclePose().get().x - x) < 0.01;
    } catch (const NotReady&) {
      return false;
    }
  }

 private:
  void check(const Command& /*command*/) const override {}
  bool takesOver() const override { return holds_checks_; }

  std::optional<RoutingTask> convert(const Command& /*command*/, const PlanStart& /*start*/) override {
    if (!has_route_) throw NoRoute("the test has taken the route away");
    return std::nullopt;
  }

  void processSpecialCommand(const Command& /*command*/, const CancelToken& cancel, MotionPlan* plan) override {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto gate = gate_;
    const bool polls_cancel = polls_cancel_;
    lock.unlock();
    gate->pass([&] {
      if (cancel.isCancelled()) gate->noteCancel();
      return polls_cancel && cancel.isCancelled();
    });
    if (polls_cancel) cancel.throwIfCancelled();
    plan->path.resize(2);
    plan->path[1].x = 10.0;
    setArcLengths(&plan->path);
  }

  std::mutex mutex_;
  std::shared_ptr<TestGate> gate_ = std::make_shared<TestGate>();
  bool polls_cancel_ = true;
  std::atomic<bool> has_route_{true}, holds_checks_{false};
};

class BlockingPlanner : public BlockingProcessor<PathFollow> {
 public:
  static constexpr const char* kService = "test/plan";
  BlockingPlanner() : BlockingProcessor<PathFollow>(kService) {}
};

/// In place of the one of this package.
class BlockingLaneFollow : public BlockingProcessor<LaneFollow> {
 public:
  BlockingLaneFollow() : BlockingProcessor<LaneFollow>("external_command/lane_follow") {}
};

/// A processor of somebody else's, whose callbacks throw.
class ThrowingProcessor : public CommandProcessor {
 public:
  static constexpr const char* kTopic = "test/throw";

 private:
  void start() override {
    const boost::function<void(const CommandStatus&)> on_message = [](const CommandStatus& message) {
      if (message.command_id == 1) throw std::runtime_error("a fault of a processor of somebody else's");
      throw 7;
    };
    subscribers_.push_back(getNodeHandle().subscribe<CommandStatus>(kTopic, 10, on_message));
    subscribers_.push_back(getMTNodeHandle().subscribe<CommandStatus>(kTopic, 10, on_message));
    timer_ = getPrivateNodeHandle().createSteadyTimer(
        ros::WallDuration(0.01), [](const ros::SteadyTimerEvent&) { throw std::logic_error("a fault in a timer"); });
  }

  std::vector<ros::Subscriber> subscribers_;
  ros::SteadyTimer timer_;
};

}  // namespace external_command
