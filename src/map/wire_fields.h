// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace external_command {

constexpr std::size_t kNoField = std::string_view::npos;

/// Where the field that begins at byte `begin` of a binary protobuf message ends, by the wire format: a tag (field
/// number and wire type), then a varint, 8 bytes, a length and as many bytes, or 4 bytes.
/// @return kNoField where no whole field is there, or one of 2 GB or more, which protobuf cannot take.
std::size_t fieldEnd(std::string_view bytes, std::size_t begin);

}  // namespace external_command
