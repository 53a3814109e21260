// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/printable.h"

#include <array>
#include <cstdint>
#include <cstdio>

#include "external_command/core/text.h"

namespace external_command {

namespace {

struct Letter {
  std::size_t size = 1;   ///< [bytes]
  bool is_shown = false;  ///< neither a control character nor broken
};

bool isControl(std::uint32_t code) {
  const bool turns_direction = (code >= 0x202a && code <= 0x202e) || (code >= 0x2066 && code <= 0x2069);
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || turns_direction;
}

/// That at `begin`, in UTF-8.
Letter letterAt(const std::string& words, std::size_t begin) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(words[i]); };
  const unsigned char first = byte(begin);
  if (first < 0x80) return {1, !isControl(first)};
  const std::size_t size = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
  if (first < 0xc2 || first > 0xf4 || begin + size > words.size()) return {};
  std::uint32_t code = first & (0x7fu >> size);
  for (std::size_t i = begin + 1; i < begin + size; ++i) {
    if ((byte(i) & 0xc0u) != 0x80u) return {};
    code = code << 6u | (byte(i) & 0x3fu);
  }
  const bool is_too_long = (size == 3 && code < 0x800) || (size == 4 && code < 0x10000);
  const bool is_no_letter = (code >= 0xd800 && code < 0xe000) || code > 0x10ffff;
  return is_too_long || is_no_letter ? Letter{} : Letter{size, !isControl(code)};
}

std::string escaped(char byte) {
  std::array<char, 5> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "\\x%02x", static_cast<unsigned>(static_cast<unsigned char>(byte)));
  return buffer.data();
}

}  // namespace

std::string printable(const std::string& words, std::size_t most) {
  std::string shown;
  for (std::size_t i = 0; i < words.size();) {
    const Letter letter = letterAt(words, i);
    std::string next = words.substr(i, letter.size);
    if (!letter.is_shown) {
      next.clear();
      for (std::size_t k = i; k < i + letter.size; ++k) next += escaped(words[k]);
    }
    if (shown.size() + next.size() > most) return shown + text("... (", words.size(), " bytes)");
    shown += next;
    i += letter.size;
  }
  return shown;
}

std::string quoted(const std::string& words) { return "'" + printable(words) + "'"; }

}  // namespace external_command
