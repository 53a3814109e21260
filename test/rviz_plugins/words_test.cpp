// SPDX-License-Identifier: Apache-2.0
#include "rviz_plugins/words.h"

#include <gtest/gtest.h>

#include "external_command/Chassis.h"
#include "external_command/CommandStatus.h"
#include "rviz_plugins/answers_view.h"
#include "rviz_plugins/readiness_view.h"

namespace external_command {
namespace {

std::string toText(const QString& words) { return words.toStdString(); }

ReadinessCondition condition(const std::string& name, bool is_met, const std::string& message,
                             const std::vector<std::string>& needed_by = {}) {
  ReadinessCondition made;
  made.name = name;
  made.is_met = is_met;
  made.message = message;
  made.needed_by = needed_by;
  return made;
}

TEST(Words, NameEveryCodeOfAStatus) {
  EXPECT_EQ(toText(codeWord(CommandStatus::OK)), "OK");
  EXPECT_EQ(toText(codeWord(CommandStatus::NO_ROUTE)), "NO_ROUTE");
  EXPECT_EQ(toText(codeWord(CommandStatus::REFUSED_BY_VEHICLE)), "REFUSED_BY_VEHICLE");
  EXPECT_EQ(toText(codeWord(CommandStatus::INTERNAL_ERROR)), "INTERNAL_ERROR");
  EXPECT_EQ(toText(codeWord(999)), "UNKNOWN_CODE");
  EXPECT_EQ(toText(statusWord(CommandStatus::RUNNING)), "RUNNING");
  EXPECT_EQ(toText(statusWord(77)), "UNKNOWN");
}

TEST(Words, TellTimesAndLengthsAsAPersonDoes) {
  EXPECT_EQ(toText(durationWords(0.0)), "0:00");
  EXPECT_EQ(toText(durationWords(59.7)), "1:00");
  EXPECT_EQ(toText(durationWords(3725.0)), "1:02:05");
  EXPECT_EQ(toText(durationWords(-5.0)), "0:00");
  EXPECT_EQ(toText(distanceWords(3.14)), "3.1 m");
  EXPECT_EQ(toText(distanceWords(312.4)), "312 m");
  EXPECT_EQ(toText(distanceWords(12345.0)), "12.3 km");
  EXPECT_EQ(toText(speedWords(10.0)), "36.0 km/h");
  EXPECT_EQ(toText(modeWords(Chassis::EMERGENCY_MODE)), "EMERGENCY");
}

TEST(Words, TellWhatAReportSays) {
  PlanReport report;
  EXPECT_EQ(toText(reportWords(report)), "");
  report.path_length = 228.0;
  report.reverse_length = 5.0;
  report.warnings = {"the bend is tight"};
  EXPECT_EQ(toText(reportWords(report)), "path 228 m, 5.0 m of it in reverse; warning: the bend is tight");
}

TEST(ReadinessWords, TellThatThereIsNoGateway) {
  EXPECT_NE(readinessWords({}).indexOf("No gateway"), -1);
  GatewayState state;
  state.is_found = true;
  EXPECT_EQ(readinessWords(state).indexOf("No gateway"), -1);
}

TEST(ReadinessWords, TellWhatIsMissingWhyAndForWhat) {
  GatewayState state;
  state.is_found = true;
  state.readiness.emplace();
  state.readiness->conditions = {condition("map", true, "loaded"),
                                 condition("pose", false, "no transform map <- base_link", {"lane_follow"})};
  const QString words = readinessWords(state);
  EXPECT_EQ(words.indexOf("Ready"), -1);
  EXPECT_NE(words.indexOf("<b>pose</b>: no transform map &lt;- base_link"), -1) << toText(words);
  EXPECT_NE(words.indexOf("(lane follow)"), -1);
  EXPECT_NE(words.indexOf("map"), -1);
  state.readiness->is_ready = true;
  state.readiness->conditions.pop_back();
  EXPECT_NE(readinessWords(state).indexOf("Ready"), -1);
}

TEST(AnswerWords, TellCommandStatusCodeAndReason) {
  Answer answer;
  answer.vehicle = "/apollo";
  answer.what = "valet parking";
  answer.command_id = 17;
  answer.status = CommandStatus::ERROR;
  answer.code = CommandStatus::NO_ROUTE;
  answer.words = "no route <here>";
  const QString words = answerWords(answer, "/apollo");
  for (const char* part : {"valet parking 17", "ERROR", "NO_ROUTE (7)", "no route &lt;here&gt;"}) {
    EXPECT_NE(words.indexOf(part), -1) << part << " is not in " << toText(words);
  }
  EXPECT_EQ(words.indexOf("/apollo"), -1);
  EXPECT_NE(answerWords(answer, "/other").indexOf("of /apollo"), -1);
}

}  // namespace
}  // namespace external_command
