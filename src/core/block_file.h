// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "archive.h"
#include "digest.h"
#include "durable_file.h"
#include "external_command/core/cancel_token.h"
#include "file_reading.h"

namespace external_command {

/// What a file of blocks is known by: words that whoever reads it compares with their own.
using BlockFileLabel = std::vector<std::string>;

/// Writes a file of blocks, each with a digest of its own: first the blocks, then the table of them with the label,
/// then the place and the digest of that table. So it is written in one go, with no more memory than a block takes.
class BlockWriter {
 public:
  /// @param cancel  looked at with each block.
  BlockWriter(const std::string& path, CancelToken cancel) : file_(path), cancel_(std::move(cancel)) {}

  /// A block of values that `write(archive)` writes.
  template <class Write>
  void block(const Write& write) {
    ArchiveWriter archive;
    write(archive);
    const std::string& bytes = archive.finish();
    add(bytes.data(), bytes.size());
  }

  /// Some blocks with the values of an array.
  template <class T>
  void array(const std::vector<T>& items) {
    static_assert(kIsPlain<T>, "values of their own bytes alone");
    const std::uint64_t size = items.size() * sizeof(T);
    add(&size, sizeof size);
    const char* bytes = reinterpret_cast<const char*>(items.data());
    for (std::size_t begin = 0; begin < size; begin += kArrayBlock) {
      add(bytes + begin, std::min<std::size_t>(kArrayBlock, size - begin));
    }
  }

  /// @throws InternalError  as all of these: it cannot be written.
  void finish(const BlockFileLabel& label);

 private:
  static constexpr std::size_t kArrayBlock = 4 << 20;  // [bytes]

  /// @throws Cancelled
  void add(const void* bytes, std::size_t size);

  durable_file::NewFile file_;
  const CancelToken cancel_;
  std::vector<std::uint64_t> table_;  ///< of each block its size [bytes] and its digest
};

/// Reads a file of blocks, these in the order of writing; nothing is looked at before its digest was compared. What is
/// to be read `later` is read by `finish`, on all processors.
class BlockReader {
 public:
  /// @throws InternalError  it cannot be read, is no such file, is damaged, or was written on another kind of machine.
  explicit BlockReader(const std::string& path);

  const BlockFileLabel& label() const { return label_; }

  /// Of the blocks that are still to be read.
  std::size_t bytesLeft() const { return next_ < blocks_.size() ? end_ - blocks_[next_].begin : 0; }

  /// The next block, by `read(archive)`.
  template <class Read>
  void block(const Read& read) {
    readBlock(next(), read);
  }

  template <class Read>
  void blockLater(Read read) {
    jobs_.push_back([this, block = next(), read = std::move(read)] { readBlock(block, read); });
  }

  /// The next array; `*items` has its size at once, and its values once `finish` was called.
  template <class T>
  void arrayLater(std::vector<T>* items) {
    static_assert(kIsPlain<T>, "values of their own bytes alone");
    const std::vector<Block> blocks = nextArray(sizeof(T));
    std::size_t size = 0;
    for (const Block& block : blocks) size += block.size;
    items->resize(size / sizeof(T));
    char* into = reinterpret_cast<char*>(items->data());
    for (const Block& block : blocks) {
      jobs_.push_back([this, block, into] { readBytes(block, into); });
      into += block.size;
    }
  }

  /// @throws InternalError  as all of these: it is damaged, or cannot be read.
  void finish();

 private:
  struct Block {
    std::size_t begin, size;
    std::uint64_t digest;
  };

  template <class Read>
  void readBlock(const Block& block, const Read& read) const {
    std::string bytes(block.size, '\0');
    readBytes(block, &bytes[0]);
    try {
      ArchiveReader archive(bytes);
      read(archive);
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  const Block& next();
  std::vector<Block> nextArray(std::size_t item_size);
  void readBytes(const Block& block, void* bytes) const;
  void readTable();
  [[noreturn]] void fail(const std::string& why) const;

  const FileReading file_;
  BlockFileLabel label_;
  std::vector<Block> blocks_;
  std::size_t end_ = 0;   ///< of the last block, in the file
  std::size_t next_ = 0;  ///< block
  std::vector<std::function<void()>> jobs_;
};

}  // namespace external_command
