// SPDX-License-Identifier: Apache-2.0
#include "wire_fields.h"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace external_command {

namespace {

constexpr std::size_t kMostVarint = 10;  // [bytes]
constexpr std::uint64_t kMostSize = std::numeric_limits<std::int32_t>::max() - 16;

/// The varint that begins `bytes`, which it is taken from; nullopt where no whole one is there.
std::optional<std::uint64_t> takeVarint(std::string_view* bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < std::min(bytes->size(), kMostVarint); ++i) {
    const auto byte = static_cast<unsigned char>((*bytes)[i]);
    value |= std::uint64_t{byte & 0x7fu} << (7 * i);
    if (byte >= 0x80) continue;
    bytes->remove_prefix(i + 1);
    return value;
  }
  return std::nullopt;
}

/// Of what follows a tag and, where the wire type has one, a varint, which is taken from `rest`.
std::optional<std::uint64_t> contentSize(std::uint64_t wire_type, std::string_view* rest) {
  switch (wire_type) {
    case 0:
      return takeVarint(rest) ? std::optional<std::uint64_t>(0) : std::nullopt;
    case 1:
      return 8;
    case 2:
      return takeVarint(rest);
    case 5:
      return 4;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<std::size_t> fieldSize(std::string_view bytes) {
  std::string_view rest = bytes;
  const auto tag = takeVarint(&rest);
  if (!tag || *tag >> 3 == 0 || *tag > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  const auto content = contentSize(*tag & 7u, &rest);
  if (!content || *content > kMostSize) return std::nullopt;
  return bytes.size() - rest.size() + static_cast<std::size_t>(*content);
}

}  // namespace external_command
