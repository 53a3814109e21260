// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "file_descriptor.h"

namespace external_command {

/// A regular file whose parts are read in any order. Thread-safe.
class FileReading {
 public:
  /// @throws InternalError  it cannot be opened, or is no regular file; a pipe is not waited for.
  explicit FileReading(const std::string& path);

  const std::string& path() const { return path_; }
  std::size_t size() const { return size_; }  ///< when it was opened [bytes]

  /// @throws InternalError  it cannot be read, or ends before.
  void read(std::size_t begin, std::size_t size, void* bytes) const;

 private:
  const std::string path_;
  const FileDescriptor file_;
  std::size_t size_ = 0;
};

}  // namespace external_command
