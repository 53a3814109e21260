// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nodelet/nodelet.h>

#include <any>
#include <memory>
#include <string>
#include <vector>

#include "external_command/ros/process_context.h"

namespace external_command {

/// Base of every processor: a nodelet, loaded by the component's list or on its own.
///
/// A derived class may   override start() to read parameters and to prepare, and open() to begin to take requests. What
///                       they throw is logged as FATAL with its text and stops the start: the processor is destroyed,
///                       whatever it has begun, while messages and requests come in.
/// What callbacks throw, on the nodelet's queues or an executor, is logged and ends that callback only.
///
/// A derived class must  not publish or subscribe before start(); context() and parameters() are there from then on, in
///                       any thread.
class CommandProcessor : public nodelet::Nodelet {
 public:
  ~CommandProcessor() override;

 protected:
  CommandProcessor();

  /// Called once, in the loading thread. @throws Error  the processor cannot start.
  virtual void start() {}

  /// Called once, after start() of the most derived class.
  virtual void open() {}

  /// Where the context's parameters are, should this be the first to ask for it: in its own namespace where it has a
  /// `map_file` there, else in that of the component, `external_command`.
  virtual ros::NodeHandle contextParameters() const;

  /// Of this namespace.
  ProcessContext& context() const { return *context_; }
  const std::shared_ptr<ProcessContext>& contextPtr() const { return context_; }

  /// In the processor's own namespace.
  const ParameterReader& parameters() const { return *parameters_; }

  /// A list parameter of topic names: `fallback` where it is not set.
  std::vector<std::string> topicNames(const std::string& key, const std::string& fallback) const;

  /// The topics that commands go to, `output_command_name`. @throws InvalidParameter  there is none.
  std::vector<std::string> outputTopics(const std::string& fallback) const;

 private:
  void onInit() final;
  void guardQueues();
  void startAll();

  // First: they outlive what is bound to them.
  std::vector<std::any> nodelet_queues_;
  std::vector<std::shared_ptr<GuardedQueue>> guarded_queues_;
  std::unique_ptr<const ParameterReader> parameters_;
  std::shared_ptr<ProcessContext> context_;
};

/// Why the nodelet of that name did not start; empty where it did, or was never loaded. nodelet::Loader tells only
/// that it failed.
std::string startFailureOf(const std::string& nodelet_name);
void noteStartFailure(const std::string& nodelet_name, const std::string& reason);

}  // namespace external_command
