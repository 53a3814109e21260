// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/master_watch.h"

#include <ros/console.h>
#include <ros/init.h>
#include <ros/master.h>
#include <ros/param.h>
#include <ros/this_node.h>
#include <xmlrpcpp/XmlRpcException.h>

#include <chrono>
#include <exception>

#include "external_command/core/text.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/name_twin.h"
#include "registrations.h"

namespace external_command {

namespace {

using XmlRpc::XmlRpcValue;

constexpr std::chrono::seconds kLookPeriod(1);

int pidOf(const XmlRpcPeer& master) { return numberOf(master.call("getPid").value, 0); }

std::size_t countOf(XmlRpcValue value) {
  if (value.getType() != XmlRpcValue::TypeStruct) return 1;
  std::size_t count = 0;
  for (const auto& item : value) count += countOf(item.second);
  return count;
}

/// Sets what of `value` the master does not have. @return how many parameters. @throws std::runtime_error
std::size_t setMissing(const XmlRpcPeer& master, const std::string& name, XmlRpcValue value) {
  const XmlRpcPeer::Answer has = master.call("hasParam", {name});
  const bool is_there = has.isSuccess() && truthOf(has.value, false);
  if (!has.isSuccess() || (!is_there && !master.call("setParam", {name, value}).isSuccess())) {
    throw std::runtime_error(text("parameter ", name, " could not be set"));
  }
  if (!is_there) return countOf(value);
  std::size_t count = 0;
  if (value.getType() != XmlRpcValue::TypeStruct) return count;
  for (const auto& [key, item] : value) count += setMissing(master, text(name, "/", key), item);
  return count;
}

}  // namespace

struct MasterWatch::KeptParameters {
  std::map<std::string, XmlRpcValue> values;
};

struct MasterWatch::Lost {
  Registrations registrations;
};

std::shared_ptr<MasterWatch> MasterWatch::ofProcess() {
  static std::mutex mutex;
  static std::weak_ptr<MasterWatch> live;
  const std::lock_guard<std::mutex> lock(mutex);
  auto watch = live.lock();
  if (!watch) live = watch = std::make_shared<MasterWatch>();
  return watch;
}

MasterWatch::MasterWatch()
    : kept_(std::make_unique<KeptParameters>()), lost_before_(std::make_unique<Lost>()), thread_([this] { run(); }) {
  keepParameters("/use_sim_time");
}

MasterWatch::~MasterWatch() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_ending_ = true;
  }
  is_ending_changed_.notify_all();
  thread_.join();
}

void MasterWatch::keepParameters(const std::string& name) {
  XmlRpcValue value;
  if (!ros::param::get(name, value)) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  kept_->values[name] = value;
}

std::vector<std::string> MasterWatch::services() {
  const auto registered = registeredBy(ros::this_node::getName(), rosMaster());
  if (!registered) return {};
  noteServices(registered->services);
  return {registered->services.begin(), registered->services.end()};
}

void MasterWatch::noteServices(const std::set<std::string>& registered) {
  const std::lock_guard<std::mutex> lock(mutex_);
  services_.insert(registered.begin(), registered.end());
}

void MasterWatch::run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!is_ending_changed_.wait_for(lock, kLookPeriod, [this] { return is_ending_; })) {
    lock.unlock();
    try {
      look();
    } catch (const std::exception& error) {
      logLater(LogLevel::kError,
               text("this node could not be made known to the ROS master again, it is tried on: ", error.what()));
    } catch (const XmlRpc::XmlRpcException& error) {
      logLater(LogLevel::kError, text("the ROS master's answer cannot be understood: ", error.getMessage()));
    }
    lock.lock();
  }
}

void MasterWatch::look() {
  const XmlRpcPeer master = rosMaster();
  const auto registered = registeredBy(ros::this_node::getName(), master);
  if (ros::isShuttingDown()) return;
  noteAnswer(registered.has_value());
  if (!registered) return;
  noteServices(registered->services);
  const int pid = pidOf(master);
  const bool is_new = registered->areNone() || (master_pid_ != 0 && pid != 0 && pid != master_pid_);
  const Registrations lost = missing(present(), *registered);
  // What is being advertised or taken back just now differs for a moment; a new master is certain at once.
  const Registrations certain = is_new ? lost : common(lost, lost_before_->registrations);
  lost_before_->registrations = lost;
  if (is_new || !certain.areNone()) {
    if (endsForTwin()) return;
    putBack(certain, is_new);
  }
  master_pid_ = pid;
}

void MasterWatch::noteAnswer(bool is_there) {
  if (is_there == !is_silent_) return;
  is_silent_ = !is_there;
  if (is_silent_) {
    logLater(LogLevel::kWarn, text("the ROS master at ", ros::master::getURI(),
                                   " does not answer; this node goes on, but nobody new finds it"));
  } else {
    logLater(LogLevel::kInfo, text("the ROS master at ", ros::master::getURI(), " answers again"));
  }
}

Registrations MasterWatch::present() {
  std::set<std::string> services;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    services = services_;
  }
  return presentOf(services);
}

/// To take the name back from a node that lives would begin an endless fight.
bool MasterWatch::endsForTwin() {
  const std::string twin = describeNameTwin();
  if (twin.empty()) return false;
  ROS_FATAL_STREAM("the name " << ros::this_node::getName() << " belongs to another node at the ROS master now, "
                               << twin << "; this one ends");
  ros::requestShutdown();
  return true;
}

void MasterWatch::putBack(const Registrations& lost, bool is_new) {
  if (is_new) {
    logLater(LogLevel::kWarn,
             text("the ROS master at ", ros::master::getURI(), " is a new one and does not know this node"));
  }
  const auto begin = std::chrono::steady_clock::now();
  const XmlRpcPeer master = rosMaster();
  std::size_t parameters = 0;
  if (is_new) {
    std::unique_lock<std::mutex> lock(mutex_);
    const auto values = kept_->values;
    lock.unlock();
    for (const auto& [name, value] : values) parameters += setMissing(master, name, value);
  }
  const bool is_complete = registerAgain(lost, master);
  const std::chrono::duration<double> duration = std::chrono::steady_clock::now() - begin;
  logLater(LogLevel::kWarn,
           text("put back at the ROS master: ", lost.services.size(), " services, ", lost.publications.size(),
                " publications, ", lost.subscriptions.size(), " subscriptions, ", parameters, " parameters, in ",
                duration.count(), " s", is_complete ? "" : "; not all was taken, the rest is tried again"));
}

}  // namespace external_command
