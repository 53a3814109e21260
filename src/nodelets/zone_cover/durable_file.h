// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace external_command {

/// Files that a crash, or a full disk, leaves as the old one or the new one, never as half of either. What fails is
/// told as the operating system tells it, with the file's name.
namespace durable_file {

/// Writes `parts` one after the other as a new file, and has the disk confirm it. Makes the folder where it is missing.
/// @throws InternalError  it cannot be written; nothing is left of it.
void create(const std::string& path, const std::vector<std::string>& parts);

/// Gives a file the name of another one, which it replaces.
/// @throws InternalError
void replace(const std::string& path, const std::string& with);

/// Its first `most` bytes.
/// @return  false where there is no such file.
/// @throws InternalError  it cannot be read.
bool read(const std::string& path, std::size_t most, std::string* content);

/// Whether there is one or not.
void remove(const std::string& path) noexcept;

}  // namespace durable_file
}  // namespace external_command
