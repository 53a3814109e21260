// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/motion_bytes.h"

#include <nav_msgs/Path.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <utility>

namespace external_command {

namespace {

namespace serialization = ros::serialization;

constexpr std::uint32_t kPointLength = 6 * sizeof(double) + 1;  // of a PathPoint [bytes]
constexpr std::uint32_t kPoseLength = 7 * sizeof(double);       // of a geometry_msgs/Pose [bytes]
constexpr std::uint32_t kCountLength = sizeof(std::uint32_t);   // of what stands before an array [bytes]

/// Room for a message of `length` bytes, and the stream that writes them.
struct Page {
  explicit Page(std::uint32_t length)
      : bytes(boost::shared_array<std::uint8_t>(new std::uint8_t[length + kCountLength]), length + kCountLength),
        stream(bytes.buf.get(), length + kCountLength) {
    stream.next(length);
    bytes.message_start = stream.getData();
  }

  /// Writes `message`, but for its last `left_out` bytes.
  template <class Message>
  void write(const Message& message, std::uint32_t left_out) {
    serialization::OStream here(stream.getData(), stream.getLength());
    serialization::serialize(here, message);
    stream.advance(static_cast<std::uint32_t>(here.getData() - stream.getData()) - left_out);
  }

  ros::SerializedMessage bytes;
  serialization::OStream stream;
};

void write(const ReferencePoint& point, serialization::OStream* stream) {
  const std::array<double, 6> values = {point.x, point.y, point.heading, point.kappa, point.s, point.speed};
  std::uint8_t* const place = stream->advance(kPointLength);
  std::memcpy(place, values.data(), sizeof(values));
  place[sizeof(values)] = static_cast<std::uint8_t>(point.direction);
}

void writePose(const ReferencePoint& point, serialization::OStream* stream) {
  const double half = point.heading / 2.0;
  const std::array<double, 7> values = {point.x, point.y, 0.0, 0.0, 0.0, std::sin(half), std::cos(half)};
  std::memcpy(stream->advance(kPoseLength), values.data(), sizeof(values));
}

}  // namespace

PreparedBytes bytesOf(const PlanningCommand& command, const Path& path) {
  assert(command.path.points.empty() && command.path.tool_on.empty());
  const std::uint32_t without_path = serialization::serializationLength(command) - 2 * kCountLength;
  const auto count = static_cast<std::uint32_t>(path.size());
  const bool uses_tool = std::any_of(path.begin(), path.end(), [](const ReferencePoint& p) { return p.tool_on; });
  const std::uint32_t tool_count = uses_tool ? count : 0;
  Page page(without_path + kCountLength + count * kPointLength + kCountLength + tool_count);
  page.write(command, 2 * kCountLength);  // the path is its last field, and ends with two arrays
  page.stream.next(count);
  for (const ReferencePoint& point : path) write(point, &page.stream);
  page.stream.next(tool_count);
  for (std::uint32_t i = 0; i < tool_count; ++i) page.stream.next(static_cast<std::uint8_t>(path[i].tool_on));
  return {std::move(page.bytes)};
}

PreparedBytes navPathBytesOf(const Path& path, const std_msgs::Header& header) {
  const std::uint32_t header_length = serialization::serializationLength(header);
  const auto count = static_cast<std::uint32_t>(path.size());
  Page page(header_length + kCountLength + count * (header_length + kPoseLength));
  const std::uint8_t* const written = page.stream.getData();
  page.stream.next(header);
  page.stream.next(count);
  for (const ReferencePoint& point : path) {
    std::memcpy(page.stream.advance(header_length), written, header_length);
    writePose(point, &page.stream);
  }
  return {std::move(page.bytes)};
}

}  // namespace external_command
