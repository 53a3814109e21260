// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/printable.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(Printable, LeavesAsTheyAreTheLettersOfAnyLanguage) {
  for (const std::string words : {"", "lane_17", "a 'b' \\n", "\u00fc\u4e2d\U0001f697"}) {
    EXPECT_EQ(printable(words), words);
  }
}

TEST(Printable, ShowsControlCharactersAsTheirBytes) {
  EXPECT_EQ(printable("a\nb"), "a\\x0ab");
  EXPECT_EQ(printable(std::string("\0\x1b[2J\x7f", 6)), "\\x00\\x1b[2J\\x7f");
  EXPECT_EQ(printable("\u0085\u202e"), "\\xc2\\x85\\xe2\\x80\\xae")
      << "a line end, and one that turns the writing round";
}

TEST(Printable, ShowsBrokenUtf8AsItsBytes) {
  EXPECT_EQ(printable("\xff\xfe"), "\\xff\\xfe");
  EXPECT_EQ(printable("a\xc3"), "a\\xc3") << "cut off";
  EXPECT_EQ(printable("\xc3(a"), "\\xc3(a") << "not gone on with";
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "longer than need be";
  EXPECT_EQ(printable("\xe0\x80\xaf"), "\\xe0\\x80\\xaf") << "longer than need be";
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80") << "half of a pair of UTF-16";
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80") << "beyond Unicode";
}

TEST(Printable, CutsALongTextBetweenLettersAndSaysHowLongItWas) {
  const std::string shown = printable(std::string(1000000, 'x'));
  EXPECT_EQ(shown, std::string(100, 'x') + "... (1000000 bytes)");
  EXPECT_EQ(printable("aa\u00fc", 3), "aa... (4 bytes)");
  EXPECT_EQ(printable("aa\n", 3), "aa... (3 bytes)");
}

TEST(Printable, QuotesAWord) { EXPECT_EQ(quoted("a\tb"), "'a\\x09b'"); }

}  // namespace
}  // namespace external_command
