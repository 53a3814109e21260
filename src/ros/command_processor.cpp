// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/command_processor.h"

#include <nodelet/detail/callback_queue.h>
#include <ros/console.h>

#include <boost/core/demangle.hpp>
#include <map>
#include <mutex>
#include <stdexcept>
#include <typeinfo>

#include "external_command/core/text.h"
#include "external_command/ros/parameter_check.h"

namespace external_command {

namespace {

struct StartFailures {
  std::mutex mutex;
  std::map<std::string, std::string> reasons;
};

StartFailures& startFailures() {
  static StartFailures failures;
  return failures;
}

/// A signal breaks off what is being asked of the master a moment before roscpp knows that it must end.
bool isEnding() {
  for (int i = 0; i < 20 && !ros::isShuttingDown(); ++i) ros::WallDuration(0.01).sleep();
  return ros::isShuttingDown();
}

/// Others may read parameters without a ParameterReader.
bool isOfThisPackage(const CommandProcessor& processor) {
  return boost::core::demangle(typeid(processor).name()).rfind("external_command::", 0) == 0;
}

}  // namespace

CommandProcessor::CommandProcessor() = default;
CommandProcessor::~CommandProcessor() {
  for (auto& queue : guarded_queues_) retire(std::move(queue));
}

void CommandProcessor::onInit() {
  guardQueues();
  std::string reason;
  try {
    startAll();
  } catch (const std::exception& error) {
    reason = error.what();
    if (reason.empty()) reason = "an exception without a text";
  } catch (...) {
    reason = "an exception of unknown type";
  }
  noteStartFailure(getName(), reason);
  if (reason.empty()) return;
  // nodelet tells nothing of what onInit throws, or ends the process where it is no std::exception. The library that
  // the original exception comes from may be closed before the exception is destroyed, so another one goes on.
  if (isEnding()) {
    ROS_WARN_STREAM(getName() << " was told to shut down while it was starting: " << reason);
  } else {
    ROS_FATAL_STREAM(getName() << " cannot start: " << reason);
  }
  throw std::runtime_error(reason);
}

void CommandProcessor::startAll() {
  parameters_ = std::make_unique<const ParameterReader>(getPrivateNodeHandle());
  context_ = ProcessContext::acquire(getNodeHandle(), contextParameters());
  start();
  open();
  const std::string& ns = getPrivateNodeHandle().getNamespace();
  context_->masterWatch().keepParameters(ns);
  if (isOfThisPackage(*this)) warnOfStrayParameters(ns);
}

/// Callbacks on the nodelet's own queues are guarded too. nodelet::Loader deletes these queues, of a nodelet that did
/// not start, before the nodelet; its subscribers would then take themselves out of a queue that is gone.
void CommandProcessor::guardQueues() {
  for (ros::NodeHandle* nh :
       {&getNodeHandle(), &getPrivateNodeHandle(), &getMTNodeHandle(), &getMTPrivateNodeHandle()}) {
    ros::CallbackQueueInterface* const queue = nh->getCallbackQueue();
    auto* const nodelets_own = dynamic_cast<nodelet::detail::CallbackQueue*>(queue);
    if (nodelets_own != nullptr) nodelet_queues_.emplace_back(nodelets_own->shared_from_this());
    guarded_queues_.push_back(std::make_shared<GuardedQueue>("the nodelet " + getName(), queue));
    nh->setCallbackQueue(guarded_queues_.back().get());
  }
}

ros::NodeHandle CommandProcessor::contextParameters() const {
  if (getPrivateNodeHandle().hasParam("map_file")) return getPrivateNodeHandle();
  return ros::NodeHandle(getNodeHandle(), "external_command");
}

std::vector<std::string> CommandProcessor::topicNames(const std::string& key, const std::string& fallback) const {
  std::vector<std::string> names = {fallback};
  parameters().readNames(key, &names);
  return names;
}

std::vector<std::string> CommandProcessor::outputTopics(const std::string& fallback) const {
  const std::string key = "output_command_name";
  const std::vector<std::string> names = topicNames(key, fallback);
  if (!names.empty()) return names;
  throw InvalidParameter(
      text("parameter ", parameters().nameOf(key), " is an empty list, commands would go nowhere; name a topic"));
}

std::string startFailureOf(const std::string& nodelet_name) {
  const std::lock_guard<std::mutex> lock(startFailures().mutex);
  return startFailures().reasons[nodelet_name];
}

void noteStartFailure(const std::string& nodelet_name, const std::string& reason) {
  const std::lock_guard<std::mutex> lock(startFailures().mutex);
  startFailures().reasons[nodelet_name] = reason;
}

}  // namespace external_command
