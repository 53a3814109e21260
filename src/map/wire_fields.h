// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace external_command {

/// As many bytes of a field always tell its size: a tag, and a varint.
constexpr std::size_t kMostHead = 20;

/// Size of the field that begins `bytes` of a binary protobuf message, tag and all, by the wire format: a tag (field
/// number and wire type), then a varint, 8 bytes, a length and as many bytes, or 4 bytes. It may be more than there are
/// bytes. O(1).
/// @return nullopt  where none begins there, or one of 2 GB or more, which protobuf cannot take, or a group, which no
///                  map has, and whose end only shows when it is there; and where fewer than kMostHead bytes do not
///                  tell.
std::optional<std::size_t> fieldSize(std::string_view bytes);

}  // namespace external_command
