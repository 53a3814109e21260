// SPDX-License-Identifier: Apache-2.0
#include "wire_fields.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/wire_format_lite.h>

#include <algorithm>
#include <cstdint>
#include <limits>

namespace external_command {

std::size_t fieldEnd(std::string_view bytes, std::size_t begin) {
  constexpr std::size_t kMost = std::numeric_limits<int>::max() - 16;
  const auto* first = reinterpret_cast<const std::uint8_t*>(bytes.data()) + begin;
  google::protobuf::io::CodedInputStream in(first, static_cast<int>(std::min(bytes.size() - begin, kMost)));
  const std::uint32_t tag = in.ReadTag();
  const bool is_whole = tag != 0 && google::protobuf::internal::WireFormatLite::SkipField(&in, tag);
  return is_whole ? begin + static_cast<std::size_t>(in.CurrentPosition()) : kNoField;
}

}  // namespace external_command
