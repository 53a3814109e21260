// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <system_error>
#include <vector>

#include "file_descriptor.h"

namespace external_command {

/// Files that a crash, or a full disk, leaves as the old one or the new one, never as half of either. What fails is
/// told as the operating system tells it, with the file's name.
namespace durable_file {

/// A new file that is written piece by piece, removed again where it is not finished. Its folder is made where it is
/// missing.
class NewFile {
 public:
  /// @throws InternalError  it cannot be made.
  explicit NewFile(const std::string& path);
  ~NewFile();
  NewFile(const NewFile&) = delete;
  NewFile& operator=(const NewFile&) = delete;

  /// Every so many bytes it has the disk confirm what there is, so that a large file leaves little for the end.
  /// @throws InternalError
  void write(const void* bytes, std::size_t size);

  /// Has the disk confirm it all.
  /// @throws InternalError
  void finish();

 private:
  void confirm();

  const std::string path_;
  const std::error_code folder_failure_;
  const FileDescriptor file_;
  std::size_t unconfirmed_ = 0;  ///< [bytes]
  bool is_finished_ = false;
};

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

/// A name beside the file, another one each time, for what is to replace it.
std::string temporaryPath(const std::string& path);

/// @throws InternalError  the disk of the file has less than `bytes` left; nothing where that is not known.
void requireRoom(const std::string& path, std::uintmax_t bytes);

/// What is taken for left where it has the number of this process.
enum class OwnFiles { kLeft, kInUse };

/// Removes what processes that were killed have left of temporary files for those whose names begin with `prefix`.
/// @param own  kLeft: this process writes none now; a process before it may have had the same number.
void removeLeftovers(const std::string& folder, const std::string& prefix, OwnFiles own);

}  // namespace durable_file
}  // namespace external_command
