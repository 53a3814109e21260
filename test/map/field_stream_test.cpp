// SPDX-License-Identifier: Apache-2.0
#include "map/field_stream.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/core/in_parallel.h"
#include "map/map_files.h"
#include "map/wire_fields.h"

namespace external_command {
namespace {

/// A field of `size` bytes, after its tag and its length.
std::string field(std::size_t size, char content) {
  std::string bytes;
  {
    google::protobuf::io::StringOutputStream out(&bytes);
    google::protobuf::io::CodedOutputStream coded(&out);
    coded.WriteTag((1 << 3) | 2);
    coded.WriteVarint32(static_cast<std::uint32_t>(size));
  }
  return bytes + std::string(size, content);
}

/// The fields of all batches, in the order of their indices; an empty text for what is no field, and ends them.
std::vector<std::string> fieldsOf(const std::string& bytes, std::size_t threads = 1) {
  const TemporaryFile path(bytes);
  const MapFile file(path.path());
  FieldStream stream(file);
  ContentDigest digest(file.size());
  std::vector<std::vector<std::string>> batches(bytes.size());
  inParallel(threads, [&](std::size_t) {
    FieldStream::Batch batch;
    while (stream.next(&batch)) {
      batch.addTo(&digest);
      std::vector<std::string>& fields = batches[batch.index];
      for (std::size_t begin = 0; begin < batch.end; begin += fields.back().size()) {
        EXPECT_EQ(bytes.compare(batch.position + begin, 8, batch.bytes, begin, 8), 0);
        fields.push_back(batch.bytes.substr(begin, fieldSize(std::string_view(batch.bytes).substr(begin)).value()));
      }
      if (batch.end == 0) fields.emplace_back();
    }
  });
  std::vector<std::string> all;
  for (const std::vector<std::string>& batch : batches) all.insert(all.end(), batch.begin(), batch.end());
  if (!all.back().empty()) {
    EXPECT_EQ(digest.value(), contentDigest(bytes));
  }
  return all;
}

std::string joined(const std::vector<std::string>& fields) {
  std::string bytes;
  for (const std::string& field : fields) bytes += field;
  return bytes;
}

TEST(FieldStream, HandsOutEachFieldOnceHoweverLong) {
  std::vector<std::string> fields;
  for (const std::size_t size : {1, 5, 700000, 3500000, 2, 1048576, 1048570, 400000, 12}) {
    fields.push_back(field(size, static_cast<char>('a' + fields.size())));
  }
  for (const std::size_t threads : {1, 3}) EXPECT_EQ(fieldsOf(joined(fields), threads), fields) << threads;
}

TEST(FieldStream, HandsOutFieldsThatEndWhereAPartDoes) {
  const std::size_t head = field(1000000, 'x').size() - 1000000;
  const std::vector<std::string> fields = {field(ContentDigest::kPartSize - head, 'a'), field(3, 'b')};
  ASSERT_EQ(fields[0].size(), ContentDigest::kPartSize);
  EXPECT_EQ(fieldsOf(joined(fields)), fields);
  EXPECT_EQ(fieldsOf(fields[0]), std::vector<std::string>{fields[0]});
}

TEST(FieldStream, EndsWithWhatIsNoWholeField) {
  const std::vector<std::string> fields = {field(2000000, 'a'), field(5, 'b')};
  const std::string whole = joined(fields);
  EXPECT_EQ(fieldsOf(whole.substr(0, whole.size() - 1)), (std::vector<std::string>{fields[0], ""}));
  EXPECT_EQ(fieldsOf(std::string(3000000, '\0')), std::vector<std::string>{""});
}

/// How much of a file is read until its fields end.
std::size_t bytesReadOf(const std::string& bytes) {
  const TemporaryFile path(bytes);
  const MapFile file(path.path());
  FieldStream stream(file);
  FieldStream::Batch batch;
  std::size_t parts = 0;
  while (stream.next(&batch)) parts += batch.parts;
  return std::min(parts * ContentDigest::kPartSize, bytes.size());
}

const std::string kVarint("\x08\x01");

std::string repeated(const std::string& bytes, std::size_t size) {
  std::string all;
  while (all.size() < size) all += bytes;
  return all;
}

TEST(FieldStream, ReadsAMapToItsEnd) {
  const std::string map = field(2500000, 'a') + repeated(kVarint, 3000000);
  EXPECT_EQ(bytesReadOf(map), map.size());
}

TEST(FieldStream, ReadsNothingBehindWhatIsNoField) {
  const std::string behind = repeated(kVarint, 5000000);
  const std::vector<std::pair<const char*, std::string>> heads = {
      {"no tag", std::string(kMostHead, '\xff')},
      {"field number 0", std::string(1, '\x02')},
      {"the end of a group", std::string(1, '\x0c')},
      {"a group without an end", std::string(1, '\x0b')},
      {"an unknown wire type", std::string(1, '\x0f')},
      {"a varint of more than 64 bits", "\x08" + std::string(11, '\xff')},
      {"a field that is longer than the file", field(6000000, 'a').substr(0, 8)},
      {"a field that protobuf cannot take", "\x0a\xff\xff\xff\xff\x7f"}};
  for (const auto& [what, head] : heads) {
    EXPECT_EQ(bytesReadOf(field(5, 'a') + head + behind), ContentDigest::kPartSize) << what;
    EXPECT_EQ(fieldsOf(field(5, 'a') + head + behind), (std::vector<std::string>{field(5, 'a'), ""})) << what;
  }
}

TEST(FieldStream, ReadsAHeadThatGoesOnInTheNextPart) {
  const std::size_t head = field(1000000, 'x').size() - 1000000;
  for (std::size_t cut = 1; cut < head; ++cut) {
    const std::vector<std::string> fields = {field(ContentDigest::kPartSize - head - cut, 'a'), field(1000000, 'b')};
    EXPECT_EQ(fieldsOf(joined(fields)), fields) << cut;
  }
}

TEST(WireFields, HaveASizeByTheirHead) {
  EXPECT_EQ(fieldSize(kVarint), 2u);
  EXPECT_EQ(fieldSize(std::string("\x09") + std::string(8, 'a') + "more"), 9u);
  EXPECT_EQ(fieldSize(std::string("\x0d") + std::string(4, 'a')), 5u);
  EXPECT_EQ(fieldSize(field(300, 'a')), 303u);
  EXPECT_EQ(fieldSize(field(300, 'a').substr(0, 3)), 303u);
  EXPECT_EQ(fieldSize(std::string("\x0a\x00", 2)), 2u);
}

TEST(WireFields, HaveNoneWhereTheHeadIsNotWhole) {
  for (const char* bytes : {"", "\x80", "\x08", "\x08\xff", "\x0a", "\x0a\x80"})
    EXPECT_EQ(fieldSize(bytes), std::nullopt);
}

TEST(FieldStream, RefusesAFileThatIsCutWhileItIsRead) {
  const TemporaryFile path(std::string(3000000, 'x'));
  const MapFile file(path.path());
  path.write("short");
  FieldStream stream(file);
  FieldStream::Batch batch;
  try {
    stream.next(&batch);
    FAIL() << "it is taken";
  } catch (const MapError& error) {
    EXPECT_NE(std::string(error.what()).find("is it still being written?"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace external_command
