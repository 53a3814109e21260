// SPDX-License-Identifier: Apache-2.0
#include "nodelets/zone_cover/zone_text.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <locale>
#include <string>

#include "external_command/core/error.h"
#include "support/refusal.h"
#include "support/zone_plans.h"

namespace external_command {
namespace {

constexpr std::uint64_t kKey = 0x0123456789abcdef;

std::string written(const CoverageProgress& progress, std::uint64_t key = kKey) {
  const std::string head = zoneHead(key, progress), lines = zoneLines(progress.lines);
  return head + lines + zoneChecksum(head, lines);
}

/// With a checksum that fits again.
std::string signedAnew(std::string text) {
  text.resize(text.rfind("checksum"));
  return text + zoneChecksum(text, "");
}

std::string refusal(const std::string& text) {
  return refusalOf([&] { parseZone(text, kKey); });
}

TEST(ZoneText, IsReadAsItWasWritten) {
  const CoverageProgress progress = begunPlan();
  EXPECT_TRUE(areEqual(parseZone(written(progress), kKey), progress));
}

/// Numbers as in "1.234,5".
struct German : std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(ZoneText, IsTheSameWhateverTheLocale) {
  const CoverageProgress progress = begunPlan();
  const std::string text = written(progress);
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new German));
  const std::string german = written(progress);
  const bool is_read = areEqual(parseZone(german, kKey), progress);
  std::locale::global(before);
  EXPECT_EQ(german, text);
  EXPECT_TRUE(is_read);
}

TEST(ZoneText, IsRefusedOrEqualWithAnyByteChanged) {
  const CoverageProgress progress = begunPlan();
  const std::string good = written(progress);
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (const int change : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ change);
      EXPECT_NE(refusal(bad), "") << "byte " << i << " changed by " << change;
    }
  }
}

TEST(ZoneText, IsRefusedCutOffAnywhereAndWithMoreBehind) {
  const std::string good = written(begunPlan());
  for (std::size_t length = 0; length < good.size(); ++length) EXPECT_NE(refusal(good.substr(0, length)), "") << length;
  EXPECT_NE(refusal(good + "\n"), "");
  EXPECT_NE(refusal(good + good), "");
}

TEST(ZoneText, TellsWhatIsWrong) {
  EXPECT_EQ(refusal(""), "it is cut off");
  EXPECT_EQ(refusal(written(begunPlan()) + " "), "its checksum is wrong");
  EXPECT_NE(refusal(written(begunPlan(), kKey + 1)).find("where '0123456789abcdef' should be"), std::string::npos);
  std::string newer = written(begunPlan());
  newer.replace(newer.find(" 3\n"), 3, " 4\n");
  EXPECT_NE(refusal(signedAnew(newer)).find("version 4"), std::string::npos) << refusal(signedAnew(newer));
}

/// Every number in turn replaced by ones that lie, the checksum made right: never gigabytes, never seconds.
TEST(ZoneText, TakesNoGigabytesWhereACountLies) {
  const std::string good = written(begunPlan());
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t i = good.find("counts"); i < good.rfind("checksum"); ++i) {
    if (good[i] != ' ' || !std::isdigit(good[i + 1])) continue;
    const std::size_t end = good.find_first_of(" \n", i + 1);
    for (const char* lie : {"100000000", "18446744073709551615", "-1", "1e300", "nan", "x"}) {
      std::string bad = good;
      bad.replace(i + 1, end - i - 1, lie);
      try {
        const CoverageProgress read = parseZone(signedAnew(bad), kKey);
        EXPECT_LE(read.lines.size(), begunPlan().lines.size());
      } catch (const InvalidRequest&) {
      }
    }
  }
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST(ZoneText, OfAHundredThousandArcsIsWrittenAndReadQuickly) {
  CoverageProgress progress;
  for (int line = 0; line < 1000; ++line) {
    progress.lines.push_back({{1.0 / 3.0, 0.1 * line, 0.0}, std::vector<ArcSegment>(100, {M_PI / 10.0, 1.0 / 7.0}), 0});
  }
  progress.sweep(999, 1.0);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(areEqual(parseZone(written(progress), kKey), progress));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2));
}

}  // namespace
}  // namespace external_command
