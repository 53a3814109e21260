// SPDX-License-Identifier: Apache-2.0
#include "file_bytes.h"

#include <sys/stat.h>

#include <cerrno>
#include <cstring>
#include <fstream>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

std::string fileBytes(const std::string& file) {
  if (file.empty()) throw MapError("no map file is named; give the path of a base_map or sim_map (~map_file)");
  struct stat status;
  if (::stat(file.c_str(), &status) != 0) {
    throw MapError(text(file, " cannot be opened: ", std::strerror(errno), "; check the path (~map_file)"));
  }
  if (S_ISDIR(status.st_mode)) {
    throw MapError(text(file, " is a folder; name the map file in it, base_map.bin for example"));
  }
  if (!S_ISREG(status.st_mode)) throw MapError(text(file, " is not a regular file; give a base_map or sim_map"));
  if (status.st_size == 0) throw MapError(text(file, " is empty; copy the map anew"));
  std::string bytes(static_cast<std::size_t>(status.st_size), '\0');
  std::ifstream in(file, std::ios::binary);
  if (!in) throw MapError(text(file, " cannot be opened: ", std::strerror(errno), "; check its permissions"));
  in.read(&bytes[0], static_cast<std::streamsize>(bytes.size()));
  if (in.gcount() != static_cast<std::streamsize>(bytes.size())) {
    throw MapError(text(file, " ended after ", in.gcount(), " of its ", bytes.size(),
                        " bytes; is it still being written? Load it again"));
  }
  return bytes;
}

}  // namespace external_command
