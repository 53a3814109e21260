// SPDX-License-Identifier: Apache-2.0
#include "core/block_file.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <numeric>

#include "external_command/core/error.h"

namespace external_command {
namespace {

enum class Colour { kRed, kGreen };

class BlockFileTest : public testing::Test {
 protected:
  void SetUp() override { path_ = testing::TempDir() + "block_file_" + std::to_string(::getpid()); }
  void TearDown() override { std::filesystem::remove(path_); }

  /// What reading the one block of a file is refused with.
  template <class Read>
  std::string refusal(const Read& read) const {
    try {
      BlockReader in(path_);
      in.block(read);
    } catch (const InternalError& error) {
      return error.what();
    }
    return "";
  }

  std::string path_;
};

TEST_F(BlockFileTest, GivesBackValuesAndArraysInTheirOrder) {
  std::vector<std::uint32_t> numbers(3000000);  // more than one block holds
  std::iota(numbers.begin(), numbers.end(), 7u);
  BlockWriter out(path_, CancelToken());
  out.block([](ArchiveWriter& archive) {
    archive.value(1.5);
    archive.value(Colour::kGreen);
    archive.value(std::optional<int>(3));
    archive.value(std::optional<int>());
    archive.values(std::string("words \0 and more", 16));
    archive.values(std::vector<Point2d>{{1, 2}, {3, 4}});
  });
  out.array(numbers);
  out.array(std::vector<double>());
  out.finish({"what", "it is"});

  BlockReader in(path_);
  EXPECT_EQ(in.label(), BlockFileLabel({"what", "it is"}));
  double value = 0.0;
  Colour colour = Colour::kRed;
  std::optional<int> some, none;
  std::string words;
  std::vector<Point2d> points;
  std::vector<std::uint32_t> read_numbers;
  std::vector<double> nothing{1.0};
  in.blockLater([&](ArchiveReader& archive) {
    archive.value(value);
    archive.value(colour);
    archive.value(some);
    archive.value(none);
    archive.values(words);
    archive.values(points);
  });
  in.arrayLater(&read_numbers);
  in.arrayLater(&nothing);
  EXPECT_EQ(in.bytesLeft(), 0u);
  in.finish();
  EXPECT_EQ(value, 1.5);
  EXPECT_EQ(colour, Colour::kGreen);
  EXPECT_EQ(some, 3);
  EXPECT_FALSE(none);
  EXPECT_EQ(words, std::string("words \0 and more", 16));
  EXPECT_EQ(points, std::vector<Point2d>({{1, 2}, {3, 4}}));
  EXPECT_EQ(read_numbers, numbers);
  EXPECT_TRUE(nothing.empty());
}

TEST_F(BlockFileTest, MakesNoRoomForMoreThanThereIs) {
  BlockWriter out(path_, CancelToken());
  out.block([](ArchiveWriter& archive) { archive.value(std::uint64_t{1} << 40); });
  out.finish({});
  std::string words;
  EXPECT_NE(refusal([&](ArchiveReader& archive) { archive.values(words); }).find("too early"), std::string::npos);
  std::vector<double> values;
  EXPECT_NE(refusal([&](ArchiveReader& archive) { archive.values(values); }).find("too early"), std::string::npos);
}

TEST_F(BlockFileTest, RefusesToReadMoreThanABlockHolds) {
  BlockWriter out(path_, CancelToken());
  out.block([](ArchiveWriter& archive) { archive.value(1); });
  out.finish({});
  double value = 0.0;
  EXPECT_NE(refusal([&](ArchiveReader& archive) { archive.value(value); }).find("damaged"), std::string::npos);
}

TEST_F(BlockFileTest, RefusesBlocksTooFewOrTooMany) {
  BlockWriter out(path_, CancelToken());
  out.array(std::vector<int>{1, 2, 3});
  out.finish({});
  EXPECT_THROW(BlockReader(path_).finish(), InternalError);
  std::vector<int> numbers, more;
  BlockReader in(path_);
  in.arrayLater(&numbers);
  EXPECT_THROW(in.arrayLater(&more), InternalError);
}

TEST_F(BlockFileTest, RefusesAnArrayOfOtherValues) {
  BlockWriter out(path_, CancelToken());
  out.array(std::vector<int>{1, 2, 3});
  out.finish({});
  std::vector<double> numbers;
  BlockReader in(path_);
  EXPECT_THROW(in.arrayLater(&numbers), InternalError);
}

TEST_F(BlockFileTest, LeavesNothingWhereItIsNotFinished) {
  BlockWriter(path_, CancelToken()).array(std::vector<int>{1, 2, 3});
  EXPECT_FALSE(std::filesystem::exists(path_));
}

}  // namespace
}  // namespace external_command
