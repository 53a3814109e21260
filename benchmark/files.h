// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fstream>
#include <string>
#include <vector>

namespace external_command {
namespace benchmark {

/// The files themselves, and all those of the folders among them that end in `extension` (with its dot), sorted.
/// @throws std::runtime_error  there is no such file or folder.
std::vector<std::string> filesOf(const std::vector<std::string>& files_and_folders, const std::string& extension);

/// @throws std::runtime_error  the file cannot be written.
std::ofstream openForWriting(const std::string& file);

/// Makes the folders that are not there yet; an empty name is none.
void makeFolders(const std::vector<std::string>& folders);

}  // namespace benchmark
}  // namespace external_command
