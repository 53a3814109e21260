// SPDX-License-Identifier: Apache-2.0
// roscpp's own function believes the length that stands before each line of a connection header, and reads up to a
// megabyte beyond what was received: whoever connects with such a header can end the process. What a program defines
// comes before what its libraries do, so these serve roscpp in the programs that they are linked into.
#include <ros/header.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "external_command/core/text.h"

namespace ros {

bool Header::parse(const boost::shared_array<std::uint8_t>& buffer, std::uint32_t size, std::string& error_msg) {
  return parse(buffer.get(), size, error_msg);
}

bool Header::parse(std::uint8_t* buffer, std::uint32_t size, std::string& error_msg) {
  std::string_view rest(reinterpret_cast<const char*>(buffer), size);
  while (!rest.empty()) {
    std::uint32_t length = 0;
    if (rest.size() < sizeof(length)) {
      error_msg = external_command::text("a connection header ends in ", rest.size(), " bytes too many");
      return false;
    }
    std::memcpy(&length, rest.data(), sizeof(length));
    rest.remove_prefix(sizeof(length));
    const std::string_view line = rest.substr(0, length);
    const std::size_t equals = line.find('=');
    if (line.size() < length || equals == std::string_view::npos) {
      error_msg = external_command::text("a line of a connection header states ", length, " bytes, has ", line.size(),
                                         ", and ", equals == std::string_view::npos ? "no" : "an", " equals sign");
      return false;
    }
    (*read_map_)[std::string(line.substr(0, equals))] = std::string(line.substr(equals + 1));
    rest.remove_prefix(length);
  }
  return true;
}

}  // namespace ros
