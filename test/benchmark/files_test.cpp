// SPDX-License-Identifier: Apache-2.0
#include "../benchmark/files.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace external_command {
namespace benchmark {
namespace {

int lengthOf(const std::string& file) {
  if (file.find("bad") != std::string::npos) throw std::runtime_error(file + " is bad");
  return static_cast<int>(file.size());
}

TEST(TryReading, GoesOnAfterAFileThatCannotBeReadAndNamesIt) {
  std::size_t unreadable = 0;
  std::vector<int> lengths;
  testing::internal::CaptureStdout();
  for (const char* file : {"a/good.json", "a/bad.json", "a/better.json"}) {
    if (const auto length = tryReading(file, lengthOf, &unreadable)) lengths.push_back(*length);
  }
  const std::string output = testing::internal::GetCapturedStdout();
  EXPECT_EQ(lengths, (std::vector<int>{11, 13}));
  EXPECT_EQ(unreadable, 1u);
  EXPECT_EQ(output.find("bad "), 0u) << output;
  EXPECT_NE(output.find("FAILED a/bad.json is bad\n"), std::string::npos) << output;
}

}  // namespace
}  // namespace benchmark
}  // namespace external_command
