// SPDX-License-Identifier: Apache-2.0
#include "core/durable_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "external_command/core/error.h"

namespace external_command {
namespace {

namespace fs = std::filesystem;

class DurableFileTest : public testing::Test {
 protected:
  void TearDown() override { fs::remove_all(folder_); }

  const std::string folder_ = testing::TempDir() + "durable_file_" + std::to_string(::getpid());
  const std::string path_ = folder_ + "/below/file";
};

TEST_F(DurableFileTest, IsReplacedAsAWhole) {
  const std::string temporary = durable_file::temporaryPath(path_);
  EXPECT_NE(temporary, durable_file::temporaryPath(path_));
  durable_file::create(temporary, {"one ", "two"});
  EXPECT_FALSE(fs::exists(path_));
  durable_file::replace(path_, temporary);
  std::string content;
  ASSERT_TRUE(durable_file::read(path_, 100, &content));
  EXPECT_EQ(content, "one two");
  EXPECT_FALSE(fs::exists(temporary));
}

TEST_F(DurableFileTest, TellsWhyItCannotBeWritten) {
  fs::create_directories(folder_);
  std::ofstream(folder_ + "/file") << "x";
  try {
    durable_file::create(folder_ + "/file/zone", {"x"});
    FAIL() << "written";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
  }
}

TEST_F(DurableFileTest, IsRemovedWhereItIsNotFinished) {
  { durable_file::NewFile(path_).write("one", 3); }
  EXPECT_FALSE(fs::exists(path_));
  durable_file::NewFile file(path_);
  file.write("one", 3);
  file.finish();
  EXPECT_EQ(fs::file_size(path_), 3u);
}

TEST_F(DurableFileTest, OfThisProcessIsLeftOverOnlyWhereThatIsSaid) {
  const std::string own = durable_file::temporaryPath(path_);
  durable_file::create(own, {"x"});
  durable_file::removeLeftovers(folder_ + "/below", "file", durable_file::OwnFiles::kInUse);
  EXPECT_TRUE(fs::exists(own));
  durable_file::removeLeftovers(folder_ + "/below", "file", durable_file::OwnFiles::kLeft);
  EXPECT_FALSE(fs::exists(own));
}

}  // namespace
}  // namespace external_command
