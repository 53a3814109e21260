// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "core/file_reading.h"

namespace external_command {

/// A map file that is read in parts, in any order. Thread-safe.
class MapFile {
 public:
  /// @throws MapError  it does not exist, cannot be read, is no regular file, or is empty.
  explicit MapFile(const std::string& path);

  const std::string& path() const { return file_.path(); }
  std::size_t size() const { return file_.size(); }  ///< [bytes]

  /// @throws MapError  it cannot be read, or has become shorter.
  void read(std::size_t begin, std::size_t size, char* bytes) const;

  /// From its beginning, as many as there are, `most` at most. @throws MapError  as read().
  std::string head(std::size_t most) const;

 private:
  const FileReading file_;
};

}  // namespace external_command
