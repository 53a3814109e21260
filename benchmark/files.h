// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <exception>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

namespace external_command {
namespace benchmark {

/// The file's name without folder and extension.
std::string stemOf(const std::string& file);

/// The files themselves, and all those of the folders among them that end in `extension` (with its dot), sorted.
/// @throws std::runtime_error  there is no such file or folder.
std::vector<std::string> filesOf(const std::vector<std::string>& files_and_folders, const std::string& extension);

/// What `read` makes of a file. Where that throws: nullopt, a line with the file's stem and the reason on standard
/// output, and one more of `unreadable`. One file is not to end the others of its folder.
template <class Read>
auto tryReading(const std::string& file, const Read& read, std::size_t* unreadable)
    -> std::optional<decltype(read(file))> {
  try {
    return read(file);
  } catch (const std::exception& error) {
    ++*unreadable;
    std::printf("%-28s FAILED %s\n", stemOf(file).c_str(), error.what());
    std::fflush(stdout);
    return std::nullopt;
  }
}

/// @throws std::runtime_error  the file cannot be written.
std::ofstream openForWriting(const std::string& file);

/// Makes the folders that are not there yet; an empty name is none.
void makeFolders(const std::vector<std::string>& folders);

}  // namespace benchmark
}  // namespace external_command
