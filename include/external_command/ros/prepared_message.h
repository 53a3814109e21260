// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <ros/publisher.h>
#include <ros/serialization.h>

namespace external_command {

/// Bytes of a message of any type, which roscpp publishes as they are. Copies share them.
struct PreparedBytes {
  ros::SerializedMessage message;
};

/// A message made ready for a topic: what is left to do then takes no time, however large it is.
class PreparedMessage {
 public:
  template <class Message>
  PreparedMessage(const ros::Publisher& publisher, const Message& message)
      : publisher_(publisher), bytes_{ros::serialization::serializeMessage(message)} {}

  PreparedMessage(const ros::Publisher& publisher, const PreparedBytes& bytes) : publisher_(publisher), bytes_(bytes) {}

  void send() const;

 private:
  ros::Publisher publisher_;
  PreparedBytes bytes_;
};

}  // namespace external_command

namespace ros {
namespace message_traits {

template <>
struct MD5Sum<external_command::PreparedBytes> {
  static const char* value() { return "*"; }
  static const char* value(const external_command::PreparedBytes&) { return value(); }
};

template <>
struct DataType<external_command::PreparedBytes> {
  static const char* value() { return "*"; }
  static const char* value(const external_command::PreparedBytes&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
inline SerializedMessage serializeMessage<external_command::PreparedBytes>(
    const external_command::PreparedBytes& bytes) {
  return bytes.message;
}

}  // namespace serialization
}  // namespace ros
