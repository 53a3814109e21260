// SPDX-License-Identifier: Apache-2.0
#include "gateway_topics.h"

#include <utility>

namespace external_command {

namespace {

constexpr std::chrono::seconds kMaxAge{1};  // of a report of the chassis
constexpr std::size_t kMaxStatuses = 100;   // kept until they are taken

}  // namespace

GatewayTopics::GatewayTopics(const std::string& vehicle) : nh_(vehicle), spinner_(1, &queue_) {
  nh_.setCallbackQueue(&queue_);
  chassis_subscriber_ = nh_.subscribe("canbus/chassis", 1, &GatewayTopics::onChassis, this);
  readiness_subscriber_ = nh_.subscribe("external_command/readiness", 1, &GatewayTopics::onReadiness, this);
  progress_subscriber_ = nh_.subscribe("external_command/progress", 10, &GatewayTopics::onProgress, this);
  status_subscriber_ = nh_.subscribe("external_command/status", 100, &GatewayTopics::onStatus, this);
  draft_publisher_ = nh_.advertise<visualization_msgs::MarkerArray>("external_command/draft", 5, true);
  look_at_publisher_ = nh_.advertise<geometry_msgs::PointStamped>("external_command/look_at", 1, true);
  spinner_.start();
}

GatewayTopics::News GatewayTopics::take() {
  const std::lock_guard<std::mutex> lock(mutex_);
  News news;
  if (chassis_ && std::chrono::steady_clock::now() - chassis_came_ < kMaxAge) news.chassis = chassis_;
  news.readiness = std::exchange(readiness_, std::nullopt);
  news.progress = std::exchange(progress_, std::nullopt);
  news.statuses.assign(statuses_.begin(), statuses_.end());
  statuses_.clear();
  return news;
}

void GatewayTopics::onChassis(const Chassis::ConstPtr& chassis) {
  const std::lock_guard<std::mutex> lock(mutex_);
  chassis_ = *chassis;
  chassis_came_ = std::chrono::steady_clock::now();
}

void GatewayTopics::onReadiness(const Readiness::ConstPtr& readiness) {
  const std::lock_guard<std::mutex> lock(mutex_);
  readiness_ = *readiness;
}

void GatewayTopics::onProgress(const CommandStatus::ConstPtr& progress) {
  const std::lock_guard<std::mutex> lock(mutex_);
  progress_ = *progress;
}

void GatewayTopics::onStatus(const CommandStatus::ConstPtr& status) {
  const std::lock_guard<std::mutex> lock(mutex_);
  statuses_.push_back(*status);
  if (statuses_.size() > kMaxStatuses) statuses_.pop_front();
}

}  // namespace external_command
