// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace external_command {

/// All of a regular file.
/// @throws MapError  it does not exist, cannot be read, is no regular file, or is empty.
std::string fileBytes(const std::string& file);

}  // namespace external_command
