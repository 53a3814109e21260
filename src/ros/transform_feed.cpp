// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/transform_feed.h"

#include <exception>

#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/log_writer.h"
#include "external_command/ros/steady_time.h"

namespace external_command {

namespace {

constexpr int kQueueSize = 100;
constexpr double kTidyPeriod = 0.5;  // [s]
constexpr double kTellPeriod = 5.0;  // between two lines of the log [s]
constexpr double kRecent = 10.0;     // a refusal is told of for so long [s]

}  // namespace

TransformFeed::TransformFeed(double max_future_stamp) : store_(max_future_stamp) {
  nh_.setCallbackQueue(executor_.queue());
  subscribe("/tf", false, &moving_);
  subscribe("/tf_static", true, &fixed_);
  tidying_ = executor_.every(kTidyPeriod, [this] { store_.tidy(ros::Time::now(), steadyNow()); });
}

TransformFeed::~TransformFeed() {
  tidying_.stop();
  moving_.shutdown();
  fixed_.shutdown();
  executor_.stop();
}

void TransformFeed::subscribe(const std::string& topic, bool is_static, ros::Subscriber* subscriber) {
  const auto callback = [this, is_static](const ros::MessageEvent<tf2_msgs::TFMessage const>& event) {
    take(*event.getConstMessage(), is_static);
  };
  *subscriber = subscribeBounded<tf2_msgs::TFMessage>(nh_, topic, kQueueSize, callback, {});
}

void TransformFeed::take(const tf2_msgs::TFMessage& message, bool is_static) {
  const ros::Time now = ros::Time::now();
  const double arrival = steadyNow();
  for (const auto& transform : message.transforms) {
    std::string problem;
    try {
      problem = store_.add(transform, is_static, now, arrival);
    } catch (const std::exception& error) {
      problem = text("a transform was dropped: ", error.what());
    } catch (...) {
      problem = "a transform was dropped: an exception of unknown type";
    }
    if (!problem.empty()) noteRefusal(problem);
  }
}

void TransformFeed::noteRefusal(const std::string& reason) {
  const double now = steadyNow();
  std::uint64_t count = 0;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    last_refusal_ = reason;
    last_refused_at_ = now;
    count = ++refused_;
  }
  if (count > 1 && now - last_told_ < kTellPeriod) return;
  last_told_ = now;
  logLater(LogLevel::kWarn, text(reason, " (", count, " refused so far)"));
}

std::string TransformFeed::recentRefusal() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (refused_ == 0 || steadyNow() - last_refused_at_ > kRecent) return "";
  return text(last_refusal_, " (", refused_, " refused so far)");
}

}  // namespace external_command
