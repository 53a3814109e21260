// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <google/protobuf/message.h>

#include <functional>
#include <stdexcept>
#include <string>

namespace external_command {

/// What is wrong with a text, and at which line and column of it.
class TextMessageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Reads protobuf's text form into `message`. Unlike protobuf's own reader, at the versions in use, it passes over
/// fields, extensions and enumerators that the description does not know; such an enumerator leaves an unknown field of
/// its field's number, as in the binary form. Fields of the types double, bytes, bool, enum and message are all that is
/// needed here, and only the latter two may be repeated.
/// @param after_field  is called after each field of `message` itself, which it may then use and clear.
/// @throws TextMessageError  the text is not a message, ends too early, or has more than 2 GB.
void readTextMessage(const std::string& bytes, google::protobuf::Message* message,
                     const std::function<void()>& after_field);

}  // namespace external_command
