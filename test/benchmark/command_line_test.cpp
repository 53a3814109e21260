// SPDX-License-Identifier: Apache-2.0
#include "../benchmark/command_line.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace external_command {
namespace benchmark {
namespace {

/// What is left of the words when `--size` takes a number and `--count` a whole one from 1 up.
std::vector<std::string> inputsOf(const std::vector<std::string>& words, double* size, int* count) {
  CommandLine line(words);
  return line.parse({{"--size", [&] { *size = line.number(); }}, {"--count", [&] { *count = line.integer(1); }}});
}

TEST(CommandLine, ReadsOptionsAndLeavesInputs) {
  double size = 0.0;
  int count = 0;
  EXPECT_EQ(inputsOf({"a", "--size", "-1.5", "b", "--count", "3"}, &size, &count),
            (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(size, -1.5);
  EXPECT_EQ(count, 3);
}

TEST(CommandLine, RefusesWhatIsUnknownMissingOrNoNumber) {
  double size = 0.0;
  int count = 0;
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--colour", "red"},
                                                                                     {"--size"},
                                                                                     {"--size", "--count", "3"},
                                                                                     {"--size", "big"},
                                                                                     {"--size", "1.5m"},
                                                                                     {"--size", "nan"},
                                                                                     {"--size", "1e999"},
                                                                                     {"--count", "0"},
                                                                                     {"--count", "1.5"},
                                                                                     {"--count", "1e20"}}) {
    EXPECT_THROW(inputsOf(words, &size, &count), std::invalid_argument) << words[0] << " " << words.back();
  }
}

}  // namespace
}  // namespace benchmark
}  // namespace external_command
