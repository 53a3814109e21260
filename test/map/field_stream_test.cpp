// SPDX-License-Identifier: Apache-2.0
#include "map/field_stream.h"

#include <google/protobuf/io/coded_stream.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>
#include <gtest/gtest.h>

#include <string>
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

/// The fields of all batches, in the order of their indices; an empty text for what is no field.
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
        fields.push_back(batch.bytes.substr(begin, fieldEnd(batch.bytes, begin) - begin));
      }
      if (batch.end == 0) fields.emplace_back();
    }
  });
  EXPECT_EQ(digest.value(), contentDigest(bytes));
  std::vector<std::string> all;
  for (const std::vector<std::string>& batch : batches) all.insert(all.end(), batch.begin(), batch.end());
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
