// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <actionlib_msgs/GoalID.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include <boost/make_shared.hpp>
#include <exception>
#include <functional>
#include <string>
#include <utility>

#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/request_limits.h"

namespace external_command {

/// A goal of an action, or what is left of one that is refused.
template <class ActionGoal>
struct ArrivedGoal {
  boost::shared_ptr<const ActionGoal> goal;  ///< with a fault: its header and id only
  std::exception_ptr fault;
};

/// Looks at the bytes of a goal before anything is built from them. Where they say more than there is, or too much, the
/// goal still comes, with the fault, so that its client can be told; it is dropped where not even its id can be read.
template <class ActionGoal>
class GoalSubscriptionHelper : public ros::SubscriptionCallbackHelper {
 public:
  using Arrived = ArrivedGoal<ActionGoal>;
  using Callback = std::function<void(const Arrived& goal, const std::string& caller)>;

  GoalSubscriptionHelper(Callback callback, std::string topic, const RequestLimits& limits)
      : callback_(std::move(callback)), topic_(std::move(topic)), limits_(limits) {}

  /// Never nullptr: roscpp would pass the bytes of an empty message on, freed.
  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const auto arrived = boost::make_shared<Arrived>();
    const auto goal = boost::make_shared<ActionGoal>();
    try {
      const char* const definition = ros::message_traits::definition<ActionGoal>();
      const MessageSize size = sizeOfMessage<ActionGoal>(params.buffer, params.length);
      limits_.requireRequest(size, definition);
      limits_.requireTexts(size, definition);
      ros::serialization::IStream stream(params.buffer, params.length);
      ros::serialization::deserialize(stream, *goal);
      arrived->goal = goal;
    } catch (...) {
      arrived->fault = std::current_exception();
      arrived->goal = namesOf(params);
    }
    return arrived;
  }

  void call(ros::SubscriptionCallbackHelperCallParams& params) override {
    const auto arrived = boost::static_pointer_cast<const Arrived>(params.event.getConstMessage());
    if (!arrived->goal) return;
    const auto caller = params.event.getConnectionHeader().find("callerid");
    callback_(*arrived, caller == params.event.getConnectionHeader().end() ? std::string() : caller->second);
  }

  const std::type_info& getTypeInfo() override { return typeid(Arrived); }  // never shared with a publisher
  bool isConst() override { return true; }
  bool hasHeader() override { return true; }

 private:
  /// Header and id of the goal, as far as they can be read and are short; else nullptr, and a line in the log.
  boost::shared_ptr<const ActionGoal> namesOf(const ros::SubscriptionCallbackHelperDeserializeParams& params) const {
    const auto goal = boost::make_shared<ActionGoal>();
    try {
      std_msgs::Header header;
      ros::serialization::IStream stream(params.buffer, params.length);
      ros::serialization::deserialize(stream, header);
      ros::serialization::deserialize(stream, goal->goal_id);
      if (goal->goal_id.id.size() <= limits_.max_text) return goal;
    } catch (const ros::serialization::StreamOverrunException&) {
      // There is no more to it.
    }
    noteDroppedMessage(topic_, *params.connection_header);
    return nullptr;
  }

  const Callback callback_;
  const std::string topic_;
  const RequestLimits limits_;
};

/// The goals of one topic.
template <class ActionGoal>
ros::Subscriber subscribeGoals(ros::NodeHandle& nh, const std::string& topic, std::uint32_t queue_size,
                               const typename GoalSubscriptionHelper<ActionGoal>::Callback& callback,
                               const RequestLimits& limits) {
  ros::SubscribeOptions options(topic, queue_size, ros::message_traits::md5sum<ActionGoal>(),
                                ros::message_traits::datatype<ActionGoal>());
  options.helper = boost::make_shared<GoalSubscriptionHelper<ActionGoal>>(callback, nh.resolveName(topic), limits);
  return nh.subscribe(options);
}

}  // namespace external_command
