// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/request_limits.h"

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

void requireBytes(std::size_t bytes, std::size_t limit, const char* what, const char* parameter) {
  if (bytes <= limit) return;
  throw InvalidRequest(
      text("the ", what, " has ", bytes, " bytes; the limit is ", limit, " (~requests/", parameter, ")"));
}

}  // namespace

void RequestLimits::requirePoints(const MessageSize& size, const char* definition) const {
  if (size.items <= max_points) return;
  throw InvalidRequest(text("the lists have ", size.items, " elements in sum, ", fieldName(definition, size.list.place),
                            " has ", size.list.size, "; the limit is ", max_points, " (~requests/max_points)"));
}

void RequestLimits::requireRequest(const MessageSize& size, const char* definition) const {
  requireBytes(size.bytes, max_bytes, "request", "max_bytes");
  requirePoints(size, definition);
}

void RequestLimits::requireMessage(const MessageSize& size, const char* definition) const {
  requireBytes(size.bytes, max_message_bytes, "message", "max_message_bytes");
  requirePoints(size, definition);
}

void RequestLimits::requireTexts(const MessageSize& size, const char* definition) const {
  if (size.text.size <= max_text) return;
  throw InvalidRequest(text(fieldName(definition, size.text.place), " has ", size.text.size, " bytes; the limit is ",
                            max_text, " (~requests/max_text)"));
}

}  // namespace external_command
