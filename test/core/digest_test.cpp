// SPDX-License-Identifier: Apache-2.0
#include "core/digest.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "external_command/core/error.h"

namespace external_command {
namespace {

class DigestTest : public testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(path_); }

  std::uint64_t ofFile(const std::string& bytes) const {
    std::ofstream(path_, std::ios::binary) << bytes;
    return contentDigestOfFile(path_);
  }

  const std::string path_ = testing::TempDir() + "digest_" + std::to_string(::getpid());
};

TEST_F(DigestTest, IsTheSameOfAFileAndOfItsBytes) {
  for (const std::size_t size : {0, 1, 1 << 20, (1 << 20) + 1, 5000000}) {
    const std::string bytes(size, 'x');
    EXPECT_EQ(ofFile(bytes), contentDigest(bytes)) << size;
  }
}

TEST_F(DigestTest, ChangesWithEachByteAndWithTheLength) {
  const std::string bytes(3000000, 'x');
  std::set<std::uint64_t> digests = {contentDigest(bytes), contentDigest(bytes + 'x'), contentDigest("")};
  for (const std::size_t place : {0, 1500000, 2999999}) {
    std::string changed = bytes;
    changed[place] = 'y';
    digests.insert(contentDigest(changed));
  }
  EXPECT_EQ(digests.size(), 6u);
}

TEST_F(DigestTest, IsRefusedOfWhatIsNoFile) {
  EXPECT_THROW(contentDigestOfFile(path_), InternalError);
  EXPECT_THROW(contentDigestOfFile(testing::TempDir()), InternalError);
}

TEST_F(DigestTest, IsWrittenAsSixteenDigits) { EXPECT_EQ(hexadecimal(0x1fULL), "000000000000001f"); }

}  // namespace
}  // namespace external_command
