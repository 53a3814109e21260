// SPDX-License-Identifier: Apache-2.0
#include "files.h"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

namespace external_command {
namespace benchmark {

namespace fs = std::filesystem;

std::string stemOf(const std::string& file) { return fs::path(file).stem().string(); }

std::vector<std::string> filesOf(const std::vector<std::string>& files_and_folders, const std::string& extension) {
  std::vector<std::string> files;
  for (const std::string& name : files_and_folders) {
    if (!fs::exists(name)) throw std::runtime_error("there is no file or folder " + name);
    if (!fs::is_directory(name)) {
      files.push_back(name);
      continue;
    }
    for (const fs::directory_entry& entry : fs::directory_iterator(name)) {
      if (entry.path().extension() == extension) files.push_back(entry.path().string());
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::ofstream openForWriting(const std::string& file) {
  std::ofstream out(file);
  if (!out) throw std::runtime_error("cannot write " + file);
  return out;
}

void makeFolders(const std::vector<std::string>& folders) {
  for (const std::string& folder : folders) {
    if (!folder.empty()) fs::create_directories(folder);
  }
}

}  // namespace benchmark
}  // namespace external_command
