// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/request_arrival.h"

#include <algorithm>
#include <limits>
#include <sstream>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr const char* kKey = "external_command_arrival";

}  // namespace

ros::M_string arrivalHeader(const CommandGate& gate, ArrivalNumber arrival, const ros::WallTime& time) {
  return {{kKey, text(gate.name(), " ", arrival, " ", time.toNSec())}};
}

ArrivalNumber earlierArrival(const ros::M_string& header, const CommandGate& gate, ArrivalNumber arrival) {
  const auto found = header.find(kKey);
  if (found == header.end()) return arrival;
  std::istringstream words(found->second);
  std::string gate_name;
  ArrivalNumber number = 0;
  std::uint64_t nanoseconds = 0;
  if (!(words >> gate_name >> number >> nanoseconds)) return arrival;
  if (gate_name == gate.name()) return std::min(number, arrival);
  constexpr std::uint64_t kNanoseconds = 1000000000;
  if (nanoseconds / kNanoseconds > std::numeric_limits<std::uint32_t>::max()) return arrival;
  const ros::WallTime time(static_cast<std::uint32_t>(nanoseconds / kNanoseconds),
                           static_cast<std::uint32_t>(nanoseconds % kNanoseconds));
  return gate.wasStoppedSince(time) ? 0 : arrival;
}

}  // namespace external_command
