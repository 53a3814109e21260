// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/log_writer.h"

#include <gtest/gtest.h>

namespace external_command {
namespace {

TEST(LogThrottle, LetsOneLineThroughPerPeriodAndCountsTheOthers) {
  LogThrottle throttle(3600.0);
  std::size_t kept_back = 99;
  EXPECT_TRUE(throttle.lets(&kept_back));
  EXPECT_EQ(kept_back, 0u);
  EXPECT_FALSE(throttle.lets(&kept_back));
  LogThrottle unlimited(0.0);
  EXPECT_TRUE(unlimited.lets(&kept_back));
  EXPECT_TRUE(unlimited.lets(&kept_back));
}

TEST(LogWriter, IsOneForAllWhoKeepIt) {
  const auto writer = LogWriter::acquire();
  EXPECT_EQ(LogWriter::acquire(), writer);
}

TEST(LogWriter, WritesWhatWaitsBeforeItEnds) {
  testing::internal::CaptureStdout();
  {
    const auto writer = LogWriter::acquire();
    for (int i = 0; i < 20; ++i) logLater(LogLevel::kInfo, "a line");
  }
  std::fflush(stdout);
  const std::string written = testing::internal::GetCapturedStdout();
  std::size_t lines = 0;
  for (std::size_t at = written.find("a line"); at != std::string::npos; at = written.find("a line", at + 1)) ++lines;
  EXPECT_EQ(lines, 20u) << written;
}

}  // namespace
}  // namespace external_command
