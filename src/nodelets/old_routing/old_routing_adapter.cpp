// SPDX-License-Identifier: Apache-2.0
#include "old_routing_adapter.h"

#include <tf2/utils.h>

#include <boost/make_shared.hpp>
#include <cmath>
#include <optional>

#include "external_command/LaneFollow.h"
#include "external_command/RoutingResponse.h"
#include "external_command/ValetParking.h"
#include "external_command/core/text.h"
#include "external_command/ros/bounded_subscription.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/request_arrival.h"
#include "external_command/ros/status.h"

namespace external_command {

namespace {

constexpr std::size_t kMaxWaiting = 10;
constexpr std::uint32_t kMaxArriving = 100;  // roscpp drops without a word, so that what is too much is to get here

template <class Service, class Command>
OldRoutingAdapter::Answer call(ros::NodeHandle& nh, const std::string& name, const Command& command,
                               const ros::M_string& header) {
  ros::ServiceClient client = nh.serviceClient<Service>(name, false, header);
  Service service;
  service.request.command = command;
  if (client.call(service)) return {service.response.status, service.response.report.warnings};
  if (!client.exists()) {
    throw NotReady(text("there is no service ", client.getService(),
                        "; is the component running, with its processor in the list ~processors?"));
  }
  throw InternalError(text("service ", client.getService(), " ended without an answer; see the component's log"));
}

/// The heading of a goal; nullopt where nobody has filled it in.
std::optional<double> headingOf(const geometry_msgs::Quaternion& q) {
  const tf2::Quaternion rotation(q.x, q.y, q.z, q.w);
  if (q.x == 0.0 && q.y == 0.0 && q.z == 0.0 && q.w == 0.0) return std::nullopt;
  const double length = rotation.length2();
  if (std::isfinite(length) && length > 1e-6) return tf2::getYaw(rotation);
  throw InvalidRequest(text("pose.orientation is (", q.x, ", ", q.y, ", ", q.z, ", ", q.w,
                            "), which is no rotation; w is 1 for a heading of 0, all are 0 where none is meant"));
}

LaneWaypoint toWaypoint(const geometry_msgs::Pose& goal) {
  requireFinite(goal.position, "pose.position");
  const std::optional<double> heading = headingOf(goal.orientation);
  LaneWaypoint waypoint;
  waypoint.pose = goal.position;
  waypoint.has_heading = heading.has_value();
  waypoint.heading = heading.value_or(0.0);
  return waypoint;
}

}  // namespace

OldRoutingAdapter::~OldRoutingAdapter() {
  request_subscriber_.shutdown();
  goal_subscriber_.shutdown();
  if (take_executor_) take_executor_->stop();
  executor_.stop();
}

void OldRoutingAdapter::start() {
  parameters().readName("routing_request_name", &request_topic_);
  parameters().readName("goal_name", &goal_topic_);
  parameters().readName("lane_follow_service_name", &lane_follow_service_);
  parameters().readName("valet_parking_service_name", &valet_parking_service_);
  double tolerance = 3.0;
  parameters().readWithin("way_point_tolerance", 0.0, 1000.0, &tolerance);
  converter_.emplace(contextPtr(), tolerance);
  response_publisher_ = context().advertise<RoutingResponse>(context().params().routing_response_topic, true);
}

void OldRoutingAdapter::open() {
  ros::NodeHandle nh(getNodeHandle());
  ExecutorOptions options;
  options.name = "the adapter's executor of requests";
  options.stamp = context().gate().arrivalStamp();
  take_executor_.emplace(options);
  nh.setCallbackQueue(take_executor_->queue());
  const auto on_request = [this](const ros::MessageEvent<RoutingRequest const>& event) {
    take(event.getConstMessage());
  };
  const RequestLimits& limits = context().params().requests;
  request_subscriber_ = subscribeBounded<RoutingRequest>(nh, request_topic_, kMaxArriving, on_request, limits);
  if (goal_topic_.empty()) return;
  const auto on_goal = [this](const ros::MessageEvent<geometry_msgs::PoseStamped const>& event) {
    takeGoal(*event.getConstMessage());
  };
  goal_subscriber_ = subscribeBounded<geometry_msgs::PoseStamped>(nh, goal_topic_, kMaxArriving, on_goal, limits);
}

void OldRoutingAdapter::takeGoal(const geometry_msgs::PoseStamped& goal) {
  const auto request = boost::make_shared<RoutingRequest>();
  request->header = goal.header;
  try {
    request->waypoint.push_back(toWaypoint(goal.pose));
  } catch (...) {
    return refuse(*request, statusFrom(std::current_exception(), 0));
  }
  take(request);
}

void OldRoutingAdapter::take(const RoutingRequest::ConstPtr& request) {
  RoutingRequest::ConstPtr dropped;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    waiting_.push_back({request, GuardedQueue::stampOfRunningCallback(), ros::WallTime::now()});
    if (waiting_.size() > kMaxWaiting) {
      dropped = waiting_.front().request;
      waiting_.pop_front();
    }
  }
  if (dropped) {
    refuse(*dropped, makeStatus(0, CommandStatus::ERROR, ErrorCode::kSuperseded,
                                text("dropped for newer requests: more than ", kMaxWaiting, " were waiting")));
  }
  executor_.post([this] { carryOutNext(); });
}

void OldRoutingAdapter::carryOutNext() {
  Waiting next;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (waiting_.empty()) return;  // it was dropped
    next = waiting_.front();
    waiting_.pop_front();
  }
  Answer answer;
  try {
    answer = carryOut(next);
  } catch (...) {
    answer.status = statusFrom(std::current_exception(), 0);
  }
  const CommandStatus& status = answer.status;
  if (status.status == CommandStatus::ERROR) return refuse(*next.request, status);
  logLater(LogLevel::kInfo, text(getName(), ": the request became command ", status.command_id, ": ", status.message));
  for (const std::string& warning : answer.warnings) {  // nobody is answered
    logLater(LogLevel::kWarn, text(getName(), ": command ", status.command_id, ": ", warning));
  }
}

OldRoutingAdapter::Answer OldRoutingAdapter::carryOut(const Waiting& waiting) {
  const RoutingRequest& request = *waiting.request;
  const ros::M_string header = arrivalHeader(context().gate(), waiting.arrival, waiting.time);
  if (request.dead_end_info.dead_end_routing_type != DeadEndInfo::ROUTING_OTHER) {
    logLater(LogLevel::kWarn, getName() + ": dead_end_info has no meaning here and is passed over");
  }
  if (hasParkingInfo(request)) {
    return call<ValetParking>(getNodeHandle(), valet_parking_service_, converter_->toValetParking(request), header);
  }
  return call<LaneFollow>(getNodeHandle(), lane_follow_service_, converter_->toLaneFollow(request), header);
}

void OldRoutingAdapter::refuse(const RoutingRequest& request, const CommandStatus& status) {
  logLater(LogLevel::kError, text(getName(), ": request refused: ", status.message));
  RoutingResponse response;
  response.header.stamp = ros::Time::now();
  response.header.frame_id = context().params().map_frame;
  response.routing_request = request;
  response.error_code = static_cast<std::uint8_t>(status.error_code);
  response.error_message = status.message;
  response_publisher_.publish(response);
}

}  // namespace external_command
