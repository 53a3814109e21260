// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "external_command/ros/message_size.h"

namespace external_command {

/// Sizes of requests and messages beyond which they are refused.
struct RequestLimits {
  std::size_t max_bytes = 10000000;          ///< of a request
  std::size_t max_message_bytes = 64000000;  ///< of a message on a topic: an obstacle grid takes a byte a cell
  std::size_t max_points = 100000;           ///< of all lists in sum, whatever is listed
  std::size_t max_text = 1000;               ///< of a text [bytes]
  std::size_t max_way_points = 1000;         ///< of a route
  std::size_t max_black_list = 10000;        ///< lanes, and as many roads
  std::size_t max_polygons = 1000;
  std::size_t max_polygon_points = 10000;

  static constexpr double kCoordinate = 1e9;  ///< to either side [m]; no map of the earth reaches further

  /// Each throws InvalidRequest; the text names the field, its size, the limit and its parameter.
  void requireRequest(const MessageSize& size, const char* definition) const;
  void requireMessage(const MessageSize& size, const char* definition) const;
  void requireTexts(const MessageSize& size, const char* definition) const;

 private:
  void requirePoints(const MessageSize& size, const char* definition) const;
};

}  // namespace external_command
