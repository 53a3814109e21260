// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <string>

#include "external_command/Any.h"
#include "external_command/core/error.h"
#include "external_command/core/printable.h"
#include "external_command/core/text.h"
#include "external_command/ros/message_size.h"

namespace external_command {

/// `message` with its type, to be carried in a field of another message.
template <class Message>
Any packAny(const Message& message) {
  Any any;
  any.type = ros::message_traits::datatype(message);
  any.md5sum = ros::message_traits::md5sum(message);
  any.data.resize(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(any.data.data(), any.data.size());
  ros::serialization::serialize(stream, message);
  return any;
}

/// The message packed into `any`.
/// @throws InvalidRequest  it holds another type, another version of the type, or damaged data.
template <class Message>
Message unpackAny(const Any& any) {
  const std::string type = ros::message_traits::datatype<Message>();
  const std::string md5sum = ros::message_traits::md5sum<Message>();
  if (any.type != type) throw InvalidRequest(text("Any holds a ", printable(any.type), "; expected a ", type));
  if (any.md5sum != md5sum) {
    throw InvalidRequest(text("Any holds a ", type, " with md5 ", printable(any.md5sum),
                              "; this program was built with ", md5sum, ": rebuild both from the same definition"));
  }
  Message message;
  try {
    sizeOfMessage<Message>(any.data.data(), any.data.size());
    // The stream only reads; roscpp's interface wants a mutable pointer.
    ros::serialization::IStream stream(const_cast<std::uint8_t*>(any.data.data()), any.data.size());
    ros::serialization::deserialize(stream, message);
  } catch (const std::exception& error) {
    throw InvalidRequest(text("Any holds a damaged ", type, " of ", any.data.size(), " bytes: ", error.what()));
  }
  return message;
}

}  // namespace external_command
