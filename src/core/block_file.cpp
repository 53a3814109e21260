// SPDX-License-Identifier: Apache-2.0
#include "block_file.h"

#include <atomic>

#include "external_command/core/error.h"
#include "external_command/core/in_parallel.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

/// Ends the file. On machines of another byte order its first number is another one.
struct Tail {
  static constexpr std::uint64_t kMark = 0x45432d626c6b3031;

  std::uint64_t mark = kMark;
  std::uint64_t table_size = 0;    // [bytes]
  std::uint64_t table_digest = 0;  // of the table and its size
};

std::uint64_t digestOfTable(std::string table) {
  table += std::to_string(table.size());
  return digestOf(table.data(), table.size());
}

}  // namespace

void BlockWriter::add(const void* bytes, std::size_t size) {
  cancel_.throwIfCancelled();
  file_.write(bytes, size);
  table_.push_back(size);
  table_.push_back(digestOf(bytes, size));
}

void BlockWriter::finish(const BlockFileLabel& label) {
  ArchiveWriter archive;
  archive.values(table_);
  archive.value(std::uint64_t{label.size()});
  for (const std::string& words : label) archive.values(words);
  const std::string& table = archive.finish();
  Tail tail;
  tail.table_size = table.size();
  tail.table_digest = digestOfTable(table);
  file_.write(table.data(), table.size());
  file_.write(&tail, sizeof tail);
  file_.finish();
}

BlockReader::BlockReader(const std::string& path) : file_(path) {
  try {
    readTable();
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    fail(error.what());
  }
}

void BlockReader::readTable() {
  Tail tail;
  if (file_.size() < sizeof tail) fail("it is too short");
  const std::size_t left = file_.size() - sizeof tail;
  file_.read(left, sizeof tail, &tail);
  if (tail.mark != Tail::kMark || tail.table_size > left) fail("its end is not what it should be");
  end_ = left - static_cast<std::size_t>(tail.table_size);
  std::string bytes(static_cast<std::size_t>(tail.table_size), '\0');
  file_.read(end_, bytes.size(), &bytes[0]);
  if (digestOfTable(bytes) != tail.table_digest) fail("its table is not what was written");
  ArchiveReader archive(bytes);
  std::vector<std::uint64_t> table;
  archive.values(table);
  std::size_t begin = 0;
  for (std::size_t i = 0; i + 1 < table.size(); i += 2) {
    if (table[i] > end_ - begin) fail("it is too short for its blocks");
    blocks_.push_back({begin, static_cast<std::size_t>(table[i]), table[i + 1]});
    begin += blocks_.back().size;
  }
  if (begin != end_) fail("it is too long for its blocks");
  label_.resize(archive.count(sizeof(std::uint64_t)));
  for (std::string& words : label_) archive.values(words);
}

void BlockReader::finish() {
  std::atomic<std::size_t> next{0};
  inParallel(parallelParts(jobs_.size()), [&](std::size_t) {
    for (std::size_t i = next++; i < jobs_.size(); i = next++) jobs_[i]();
  });
  jobs_.clear();
  if (next_ != blocks_.size()) fail("it has more blocks than it should have");
}

const BlockReader::Block& BlockReader::next() {
  if (next_ >= blocks_.size()) fail("it has fewer blocks than it should have");
  return blocks_[next_++];
}

std::vector<BlockReader::Block> BlockReader::nextArray(std::size_t item_size) {
  const Block& head = next();
  std::uint64_t size = 0;
  if (head.size != sizeof size) fail("an array has no size");
  readBytes(head, &size);
  if (size % item_size != 0) fail("the size of an array is odd");
  std::vector<Block> blocks;
  for (std::uint64_t found = 0; found < size; found += blocks.back().size) {
    blocks.push_back(next());
    if (blocks.back().size == 0 || blocks.back().size > size - found) fail("the size of an array is odd");
  }
  return blocks;
}

void BlockReader::readBytes(const Block& block, void* bytes) const {
  file_.read(block.begin, block.size, bytes);
  if (digestOf(bytes, block.size) != block.digest) {
    fail(text("the ", block.size, " bytes from byte ", block.begin, " on are not what was written"));
  }
}

void BlockReader::fail(const std::string& why) const { throw InternalError(text(file_.path(), " is damaged: ", why)); }

}  // namespace external_command
