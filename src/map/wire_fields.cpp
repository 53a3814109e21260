// SPDX-License-Identifier: Apache-2.0
#include "wire_fields.h"

#include <google/protobuf/io/coded_stream.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace external_command {

std::optional<std::size_t> fieldSize(std::string_view bytes) {
  constexpr std::uint64_t kMostSize = std::numeric_limits<std::int32_t>::max() - 16;
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data());
  google::protobuf::io::CodedInputStream in(first, static_cast<int>(std::min(bytes.size(), kMostHead)));
  const std::uint32_t tag = in.ReadTag();
  if (tag >> 3 == 0) return std::nullopt;
  std::uint64_t value = 0, content = 0;
  switch (tag & 7u) {  // the wire type
    case 0:
      if (!in.ReadVarint64(&value)) return std::nullopt;
      break;
    case 1:
      content = 8;
      break;
    case 2:
      if (!in.ReadVarint64(&content)) return std::nullopt;
      break;
    case 5:
      content = 4;
      break;
    default:
      return std::nullopt;
  }
  if (content > kMostSize) return std::nullopt;
  return static_cast<std::size_t>(in.CurrentPosition()) + static_cast<std::size_t>(content);
}

}  // namespace external_command
