// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/readiness_topic.h"

#include <algorithm>
#include <cctype>
#include <string>

#include "external_command/ros/status.h"

namespace external_command {

namespace {

constexpr double kRefreshPeriod = 5.0;  // of numbers in messages [s]

std::string withoutNumbers(std::string message) {
  const auto isOfNumber = [](unsigned char c) { return std::isdigit(c) != 0 || c == '.'; };
  message.erase(std::remove_if(message.begin(), message.end(), isOfNumber), message.end());
  return message;
}

bool saysTheSame(const ReadinessCondition& a, const ReadinessCondition& b) {
  return a.name == b.name && a.is_met == b.is_met && a.needed_by == b.needed_by &&
         withoutNumbers(a.message) == withoutNumbers(b.message);
}

bool isEqual(const ReadinessCondition& a, const ReadinessCondition& b) {
  return saysTheSame(a, b) && a.message == b.message;
}

}  // namespace

Readiness toMsg(const std::vector<Condition>& conditions) {
  Readiness readiness;
  readiness.header.stamp = ros::Time::now();
  readiness.is_ready = true;
  for (const Condition& condition : conditions) {
    ReadinessCondition message;
    message.name = condition.name;
    message.is_met = condition.is_met;
    message.message = statusMessage(condition.message);
    message.needed_by = condition.needed_by;
    readiness.is_ready = readiness.is_ready && condition.is_met;
    readiness.conditions.push_back(message);
  }
  return readiness;
}

bool sayTheSame(const Readiness& a, const Readiness& b) {
  return std::equal(a.conditions.begin(), a.conditions.end(), b.conditions.begin(), b.conditions.end(), saysTheSame);
}

void ReadinessTopic::update() {
  Readiness now = toMsg(conditions_.look());
  const bool is_equal = std::equal(now.conditions.begin(), now.conditions.end(), last_.conditions.begin(),
                                   last_.conditions.end(), isEqual);
  const bool is_recent = (ros::SteadyTime::now() - published_at_).toSec() < kRefreshPeriod;
  if (is_published_ && (is_equal || (is_recent && sayTheSame(now, last_)))) return;
  publisher_.publish(now);
  last_ = std::move(now);
  published_at_ = ros::SteadyTime::now();
  is_published_ = true;
}

}  // namespace external_command
