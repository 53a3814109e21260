// SPDX-License-Identifier: Apache-2.0
#include "external_command/core/error.h"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>

namespace external_command {
namespace {

constexpr int kCodes = 16;

TEST(ErrorCode, HasTheNamesAndNumbersOfTheMessage) {
  std::ifstream in(std::string(EC_SOURCE_DIR) + "/msg/CommandStatus.msg");
  ASSERT_TRUE(in);
  std::map<int, std::string> stated;
  const std::regex constant("uint16 ([A-Z_]+) *= *([0-9]+).*");
  std::smatch match;
  for (std::string line; std::getline(in, line);) {
    if (std::regex_match(line, match, constant)) stated[std::stoi(match[2])] = match[1];
  }
  ASSERT_EQ(stated.size(), static_cast<std::size_t>(kCodes));
  for (const auto& [number, name] : stated) EXPECT_EQ(toString(static_cast<ErrorCode>(number)), name);
}

TEST(ErrorCode, HasANameEvenWhereItIsNone) { EXPECT_STREQ(toString(static_cast<ErrorCode>(99)), "UNKNOWN_CODE"); }

template <class Thrown>
void expectCode(ErrorCode code) {
  try {
    throw Thrown("what happened");
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_STREQ(error.what(), "what happened");
  }
}

TEST(Error, CarriesTheCodeOfItsTypeThroughItsBase) {
  expectCode<InvalidRequest>(ErrorCode::kInvalidRequest);
  expectCode<StaleRequest>(ErrorCode::kStaleRequest);
  expectCode<DuplicateId>(ErrorCode::kDuplicateId);
  expectCode<UnknownId>(ErrorCode::kUnknownId);
  expectCode<NotReady>(ErrorCode::kNotReady);
  expectCode<OffMap>(ErrorCode::kOffMap);
  expectCode<NoRoute>(ErrorCode::kNoRoute);
  expectCode<StartBlocked>(ErrorCode::kStartBlocked);
  expectCode<GoalBlocked>(ErrorCode::kGoalBlocked);
  expectCode<NoPath>(ErrorCode::kNoPath);
  expectCode<PlanningTimeout>(ErrorCode::kPlanningTimeout);
  expectCode<Cancelled>(ErrorCode::kCancelled);
  expectCode<Superseded>(ErrorCode::kSuperseded);
  expectCode<RefusedByVehicle>(ErrorCode::kRefusedByVehicle);
  expectCode<InternalError>(ErrorCode::kInternalError);
  expectCode<InvalidParameter>(ErrorCode::kInternalError);
  expectCode<MapError>(ErrorCode::kInternalError);
}

TEST(Error, OfParametersAndMapsIsAnInternalOne) {
  EXPECT_THROW(throw InvalidParameter("x"), InternalError);
  EXPECT_THROW(throw MapError("x"), InternalError);
  EXPECT_THROW(throw NoRoute("x"), std::runtime_error);
}

}  // namespace
}  // namespace external_command
