// SPDX-License-Identifier: Apache-2.0
// What src/nodelets/process/connection_header.cpp puts in the place of roscpp's own.
#include <gtest/gtest.h>
#include <ros/header.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace external_command {
namespace {

/// Bytes behind which nothing may be read.
class FencedBytes {
 public:
  explicit FencedBytes(const std::string& bytes) : page_(static_cast<std::size_t>(::sysconf(_SC_PAGESIZE))) {
    pages_ = ::mmap(nullptr, 2 * page_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    EXPECT_NE(pages_, MAP_FAILED);
    EXPECT_EQ(::mprotect(static_cast<char*>(pages_) + page_, page_, PROT_NONE), 0);
    begin_ = static_cast<std::uint8_t*>(pages_) + page_ - bytes.size();
    std::memcpy(begin_, bytes.data(), bytes.size());
  }
  ~FencedBytes() { ::munmap(pages_, 2 * page_); }
  FencedBytes(const FencedBytes&) = delete;
  FencedBytes& operator=(const FencedBytes&) = delete;

  std::uint8_t* begin() const { return begin_; }

 private:
  std::size_t page_;
  void* pages_ = nullptr;
  std::uint8_t* begin_ = nullptr;
};

std::string length(std::uint32_t value) { return {reinterpret_cast<const char*>(&value), sizeof(value)}; }

std::string line(const std::string& text) { return length(static_cast<std::uint32_t>(text.size())) + text; }

/// The error text, empty where the header is taken.
std::string errorOf(const std::string& bytes, ros::Header* header) {
  const FencedBytes fenced(bytes);
  std::string error;
  const bool is_taken = header->parse(fenced.begin(), static_cast<std::uint32_t>(bytes.size()), error);
  EXPECT_EQ(is_taken, error.empty());
  return error;
}

std::string errorOf(const std::string& bytes) {
  ros::Header header;
  return errorOf(bytes, &header);
}

TEST(ConnectionHeader, IsReadAsRoscppWritesIt) {
  const ros::M_string values{{"callerid", "/somebody"}, {"md5sum", "*"}, {"empty", ""}, {"two", "a=b"}};
  boost::shared_array<std::uint8_t> written;
  std::uint32_t size = 0;
  ros::Header::write(values, written, size);
  ros::Header header;
  EXPECT_EQ(errorOf(std::string(reinterpret_cast<const char*>(written.get()), size), &header), "");
  EXPECT_EQ(*header.getValues(), values);
}

TEST(ConnectionHeader, MayBeEmpty) { EXPECT_EQ(errorOf(""), ""); }

TEST(ConnectionHeader, IsRefusedWhereALineStatesMoreThanIsThere) {
  for (const std::uint32_t stated : {4U, 100U, 999'000U, 0x7fffffffU, 0xffffffffU}) {
    EXPECT_NE(errorOf(length(stated) + "a=b"), "") << stated;
    EXPECT_NE(errorOf(line("callerid=/bad") + length(stated)), "") << stated;
  }
}

TEST(ConnectionHeader, IsRefusedWhereItEndsWithinALength) {
  for (const std::size_t left : {1U, 2U, 3U}) EXPECT_NE(errorOf(line("a=b") + std::string(left, '\0')), "") << left;
}

TEST(ConnectionHeader, IsRefusedWhereALineHasNoEqualsSign) {
  EXPECT_NE(errorOf(line("callerid")), "");
  EXPECT_NE(errorOf(length(0)), "");
}

}  // namespace
}  // namespace external_command
