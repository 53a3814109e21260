// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

namespace external_command {

/// A text of somebody else's, fit to be shown: control characters and broken UTF-8 as `\xNN`; of more than `most`
/// bytes the first only, and how many there were.
std::string printable(const std::string& words, std::size_t most = 100);

/// The same, between single quotes.
std::string quoted(const std::string& words);

}  // namespace external_command
