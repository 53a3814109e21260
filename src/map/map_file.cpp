// SPDX-License-Identifier: Apache-2.0
#include "map_file.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

FileReading opened(const std::string& path) {
  if (path.empty()) throw MapError("no map file is named; give the path of a base_map or sim_map (~map_file)");
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) {
    throw MapError(text(path, " cannot be opened: ", std::strerror(errno), "; check the path (~map_file)"));
  }
  if (S_ISDIR(status.st_mode)) {
    throw MapError(text(path, " is a folder; name the map file in it, base_map.bin for example"));
  }
  if (!S_ISREG(status.st_mode)) throw MapError(text(path, " is not a regular file; give a base_map or sim_map"));
  if (status.st_size == 0) throw MapError(text(path, " is empty; copy the map anew"));
  try {
    return FileReading(path);
  } catch (const InternalError& error) {
    throw MapError(text(error.what(), "; check its permissions"));
  }
}

}  // namespace

MapFile::MapFile(const std::string& path) : file_(opened(path)) {}

void MapFile::read(std::size_t begin, std::size_t size, char* bytes) const {
  try {
    file_.read(begin, size, bytes);
  } catch (const InternalError& error) {
    throw MapError(
        text(error.what(), "; it had ", this->size(), " when it was opened: is it still being written? Load it again"));
  }
}

std::string MapFile::head(std::size_t most) const {
  std::string bytes(std::min(most, size()), '\0');
  read(0, bytes.size(), &bytes[0]);
  return bytes;
}

}  // namespace external_command
