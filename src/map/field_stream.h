// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

#include "core/digest.h"
#include "map_file.h"

namespace external_command {

/// The fields of the binary protobuf message in a map file, handed out in batches of about a megabyte: a map of
/// gigabytes is never in memory as a file, too. What makes no sense as a field ends them: what lies behind it is not
/// read. Thread-safe.
class FieldStream {
 public:
  /// Some fields that stand behind each other, or, as the last one, what makes no sense as a field. To be used for one
  /// after the other, so that its memory is.
  struct Batch {
    std::size_t index = 0;     ///< in the file's order
    std::size_t position = 0;  ///< of its first byte in the file
    std::size_t end = 0;       ///< of its fields, in `bytes`; 0: the first byte is not the beginning of a whole field
    std::string bytes;         ///< some of the next batch may follow
    std::size_t first_part = 0, parts = 0;  ///< of the file's content, as ContentDigest has them, that end `bytes` ...
    std::size_t parts_begin = 0;            ///< ... from here on

    /// Each part of the file that is read is in one batch.
    void addTo(ContentDigest* digest) const;
  };

  explicit FieldStream(const MapFile& file) : file_(file) {}

  /// @return  false where there are no more.
  /// @throws MapError  the file cannot be read.
  bool next(Batch* batch);

 private:
  void readPart(Batch* batch);
  void findEnd(Batch* batch);

  const MapFile& file_;
  std::mutex mutex_;
  std::size_t batches_ = 0;
  std::size_t parts_read_ = 0;
  std::size_t bytes_read_ = 0;
  bool is_broken_ = false;  ///< what follows the fields so far makes no sense, whatever is read yet
  std::string rest_;        ///< the beginning of a field that goes on in what is not read yet
};

}  // namespace external_command
