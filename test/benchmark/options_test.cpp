// SPDX-License-Identifier: Apache-2.0
#include "../benchmark/options.h"

#include <gtest/gtest.h>

namespace external_command {
namespace benchmark {
namespace {

class Options : public testing::Test {
 protected:
  bool isRead(const std::vector<std::string>& words) {
    inputs.clear();
    boost::program_options::options_description options;
    options.add_options()("size", number("size", &size), "how large")("count", integer("count", 1, &count), "how many");
    return parse(words, options, &inputs);
  }

  double size = 0.0;
  int count = 2;
  std::vector<std::string> inputs;
};

TEST_F(Options, AreReadAndInputsLeft) {
  EXPECT_TRUE(isRead({"a", "--size", "-1.5", "b", "--count", "3"}));
  EXPECT_EQ(inputs, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(size, -1.5);
  EXPECT_EQ(count, 3);
}

TEST_F(Options, MayAskForHelpOnly) {
  EXPECT_FALSE(isRead({"--help"}));
  EXPECT_FALSE(isRead({"a", "--count", "3", "--help"}));
  EXPECT_EQ(count, 2);
}

TEST_F(Options, AreRefusedWhereUnknownMissingOrNoNumber) {
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{{"--colour", "red"},
                                                                                     {"--siz", "3"},
                                                                                     {"--size"},
                                                                                     {"--size", "--count", "3"},
                                                                                     {"--size", "big"},
                                                                                     {"--size", "1.5m"},
                                                                                     {"--size", "nan"},
                                                                                     {"--size", "1e999"},
                                                                                     {"--count", "0"},
                                                                                     {"--count", "1.5"},
                                                                                     {"--count", "1e20"}}) {
    try {
      isRead(words);
      ADD_FAILURE() << words[0] << " " << words.back() << " is taken";
    } catch (const boost::program_options::error& error) {
      EXPECT_NE(std::string(error.what()).find(words[0]), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace benchmark
}  // namespace external_command
