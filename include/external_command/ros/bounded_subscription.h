// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/message_event.h>
#include <ros/node_handle.h>
#include <ros/subscription_callback_helper.h>

#include <boost/function.hpp>
#include <boost/make_shared.hpp>
#include <string>

#include "external_command/ros/request_limits.h"

namespace external_command {

/// Logs, at most once in 10 s, that the exception that is being handled ended a message of `topic`.
void noteDroppedMessage(const std::string& topic, const ros::M_string& header);

enum class LongTexts { kRefused, kTaken };

/// Looks at the bytes of a message before anything is built from them, and drops it where they say more than there is,
/// or it is too large.
template <class Message>
class BoundedSubscriptionHelper : public ros::SubscriptionCallbackHelperT<const ros::MessageEvent<Message const>&> {
 public:
  using Base = ros::SubscriptionCallbackHelperT<const ros::MessageEvent<Message const>&>;

  BoundedSubscriptionHelper(const typename Base::Callback& callback, std::string topic, const RequestLimits& limits,
                            LongTexts long_texts)
      : Base(callback), topic_(std::move(topic)), limits_(limits), long_texts_(long_texts) {}

  ros::VoidConstPtr deserialize(const ros::SubscriptionCallbackHelperDeserializeParams& params) override {
    const char* const definition = ros::message_traits::definition<Message>();
    try {
      const MessageSize size = sizeOfMessage<Message>(params.buffer, params.length);
      limits_.requireMessage(size, definition);
      if (long_texts_ == LongTexts::kRefused) limits_.requireTexts(size, definition);
      return Base::deserialize(params);
    } catch (...) {
      noteDroppedMessage(topic_, *params.connection_header);
      return params.length == 0 ? nothing() : ros::VoidConstPtr();
    }
  }

  void call(ros::SubscriptionCallbackHelperCallParams& params) override {
    if (params.event.getConstMessage() != nothing()) Base::call(params);
  }

 private:
  /// In place of a dropped message of no bytes: roscpp would take that to the next subscriber of this process once
  /// more, as a buffer that it has freed (MessageDeserializer tells by `num_bytes > 0` whether it has tried before).
  static ros::VoidConstPtr nothing() {
    static const ros::VoidConstPtr message = boost::make_shared<Message>();
    return message;
  }

  const std::string topic_;
  const RequestLimits limits_;
  const LongTexts long_texts_;
};

template <class Message>
using MessageCallback = boost::function<void(const ros::MessageEvent<Message const>&)>;

/// A subscriber whose messages are bounded. @param long_texts  taken: the callback cuts them itself.
template <class Message>
ros::Subscriber subscribeBounded(ros::NodeHandle& nh, const std::string& topic, std::uint32_t queue_size,
                                 const MessageCallback<Message>& callback, const RequestLimits& limits,
                                 LongTexts long_texts = LongTexts::kRefused) {
  ros::SubscribeOptions options(topic, queue_size, ros::message_traits::md5sum<Message>(),
                                ros::message_traits::datatype<Message>());
  options.helper =
      boost::make_shared<BoundedSubscriptionHelper<Message>>(callback, nh.resolveName(topic), limits, long_texts);
  return nh.subscribe(options);
}

}  // namespace external_command
