// SPDX-License-Identifier: Apache-2.0
#include "wire_fields.h"

#include <cstdint>
#include <limits>
#include <optional>

namespace external_command {

namespace {

/// Seven bits per byte, the lowest first; the last byte has its top bit clear. Moves `position` behind it.
std::optional<std::uint64_t> readVarint(const std::string& bytes, std::size_t* position) {
  std::uint64_t value = 0;
  for (unsigned shift = 0; shift < 64 && *position < bytes.size(); shift += 7) {
    const auto byte = static_cast<unsigned char>(bytes[(*position)++]);
    value |= static_cast<std::uint64_t>(byte & 0x7f) << shift;
    if (byte < 0x80) return value;
  }
  return std::nullopt;
}

}  // namespace

std::size_t fieldEnd(const std::string& bytes, std::size_t begin) {
  std::size_t position = begin;
  const auto tag = readVarint(bytes, &position);
  if (!tag) return kNoField;
  std::uint64_t size = 0;
  switch (*tag & 7) {
    case 0:
      if (!readVarint(bytes, &position)) return kNoField;
      break;
    case 1:
      size = 8;
      break;
    case 2: {
      const auto length = readVarint(bytes, &position);
      if (!length) return kNoField;
      size = *length;
      break;
    }
    case 5:
      size = 4;
      break;
    default:
      return kNoField;
  }
  constexpr std::uint64_t kLimit = std::numeric_limits<int>::max() - 16;
  return size > bytes.size() - position || size > kLimit ? kNoField : position + size;
}

}  // namespace external_command
