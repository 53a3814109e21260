// SPDX-License-Identifier: Apache-2.0
#include "gateway_link.h"

#include <ros/master.h>
#include <ros/names.h>
#include <ros/service.h>

#include <cmath>
#include <utility>

#include "external_command/Action.h"
#include "external_command/FreeSpace.h"
#include "external_command/GetCurrentCommand.h"
#include "external_command/LaneFollow.h"
#include "external_command/PathFollow.h"
#include "external_command/PreciseParking.h"
#include "external_command/Speed.h"
#include "external_command/ValetParking.h"
#include "external_command/ZoneCover.h"
#include "words.h"

namespace external_command {

namespace {

constexpr int kNewsPeriod = 100;   // [ms]
constexpr int kLookPeriod = 1000;  // between two looks whether the gateway is there [ms]
constexpr int kPatience = 5000;    // after which a call without an answer is told of [ms]
constexpr int kMaxAtWork = 50;     // calls but for stops; more come of a server that hangs
constexpr std::size_t kMaxEnded = 50;
constexpr std::chrono::milliseconds kFarewell{1000};  // in which topics are left when rviz ends

const char* const kStatusTopic = "/external_command/status";

QString actionWords(std::uint8_t action) {
  switch (action) {
    case ActionCommand::STOP:
      return "STOP";
    case ActionCommand::START:
      return "start";
    case ActionCommand::CLEAR_PLANNING:
      return "clear planning";
    case ActionCommand::SWITCH_TO_AUTO:
      return "switch to auto";
    case ActionCommand::SWITCH_TO_MANUAL:
      return "switch to manual";
    default:
      return QString("action %1").arg(action);
  }
}

bool isMotion(const std::string& service) {
  static const std::set<std::string> motions = {"lane_follow", "valet_parking",   "free_space",
                                                "path_follow", "precise_parking", "zone_cover"};
  return motions.count(service) > 0;
}

bool hasEnded(const CommandStatus& status) { return status.status != CommandStatus::RUNNING; }

Answer withStatus(Answer answer, const CommandStatus& status) {
  answer.command_id = status.command_id;
  answer.status = status.status;
  answer.code = status.error_code;
  answer.words = QString::fromStdString(status.message);
  return answer;
}

Action actionOf(std::uint8_t command) {
  Action action;
  action.request.command.header.stamp = ros::Time::now();
  action.request.command.command = command;
  return action;
}

}  // namespace

GatewayLink::GatewayLink(QObject* parent) : QObject(parent) {
  connect(&news_timer_, &QTimer::timeout, this, &GatewayLink::takeNews);
  connect(&look_timer_, &QTimer::timeout, this, &GatewayLink::lookForGateway);
  news_timer_.start(kNewsPeriod);
  look_timer_.start(kLookPeriod);
}

GatewayLink::~GatewayLink() {
  // To leave topics is told to the ROS master.
  if (topics_) background_.run([topics = std::move(topics_)] { return Background::Job([] {}); });
  background_.waitForEnd(kFarewell);
}

std::string GatewayLink::nameOf(const std::string& service) const { return vehicle_ + "/external_command/" + service; }

void GatewayLink::connectTo(const std::string& vehicle) {
  std::string error;
  const std::string resolved = ros::names::validate(vehicle, error) ? ros::names::resolve(vehicle) : "";
  if (!error.empty() || (resolved == vehicle_ && connection_ > 0)) {
    if (!error.empty()) Q_EMIT answered({vehicle, "", "connect", 0, std::nullopt, 0, QString::fromStdString(error)});
    return;
  }
  const int connection = ++connection_;
  vehicle_ = resolved == "/" ? "" : resolved;
  state_ = {};
  forgetCommands();
  is_looking_ = false;
  stop_line_ = std::make_shared<StopLine>(nameOf("action"));
  background_.run([old = std::move(topics_)]() mutable {
    old.reset();
    return Background::Job([] {});
  });
  topics_ = nullptr;
  background_.run([this, connection, name = vehicle_]() -> Background::Job {
    const auto made = std::make_shared<GatewayTopics>(name);
    return [this, connection, made] {
      if (connection != connection_) return;
      topics_ = made;
      if (draft_) topics_->publishDraft(*draft_);
    };
  });
  lookForGateway();
  Q_EMIT stateChanged();
}

void GatewayLink::lookForGateway() {
  if (!stop_line_ || is_looking_) return;
  is_looking_ = true;
  const int connection = connection_;
  const bool is_begun = background_.run([this, connection, line = stop_line_]() -> Background::Job {
    const bool is_there = line->keep();
    return [this, connection, is_there] {
      if (connection != connection_) return;
      is_looking_ = false;
      const bool is_new = is_there && !state_.is_found;
      const bool has_changed = is_there != state_.is_found;
      state_.is_found = is_there;
      if (!is_there) forgetCommands();
      if (is_new) askWhatRuns();
      if (has_changed) Q_EMIT stateChanged();
    };
  });
  if (!is_begun) is_looking_ = false;
}

void GatewayLink::forgetCommands() {
  state_.motion.reset();
  state_.readiness.reset();
  running_.clear();
  ended_.clear();
}

void GatewayLink::askWhatRuns() {
  const int connection = connection_;
  background_.run([this, connection, name = nameOf("current_command")]() -> Background::Job {
    GetCurrentCommand current;
    if (!ros::service::exists(name, false) || !ros::service::call(name, current)) return [] {};
    return [this, connection, motion = current.response.motion] {
      if (connection != connection_ || motion.command_id == 0 || state_.motion) return;
      state_.motion = motion;
      Q_EMIT stateChanged();
    };
  });
}

void GatewayLink::stop() {
  const Answer asked = {vehicle_, "action", actionWords(ActionCommand::STOP)};
  const int call = ++last_call_;
  watch(call, asked);
  const bool is_begun = background_.run([this, call, asked, line = stop_line_]() -> Background::Job {
    Action action = actionOf(ActionCommand::STOP);
    const bool is_answered = line && line->call(&action);
    return [this, call, asked, is_answered, status = action.response.status] {
      waiting_.erase(call);
      is_answered ? take(asked, status) : fail(asked, asked.vehicle + "/external_command/action");
    };
  });
  if (is_begun) return;
  waiting_.erase(call);
  fail(asked, "a thread");
}

template <class Service>
void GatewayLink::call(const std::string& name, const Answer& asked, const typename Service::Request& request,
                       const Reply<Service>& reply) {
  const std::string service = nameOf(name);
  const int call = ++last_call_;
  watch(call, asked);
  const auto work = [this, service, call, asked, request, reply]() -> Background::Job {
    typename Service::Response response;
    const bool is_answered = ros::NodeHandle().serviceClient<Service>(service).call(request, response);
    return [this, service, call, asked, reply, is_answered, response] {
      waiting_.erase(call);
      is_answered ? reply(response) : fail(asked, service);
    };
  };
  if (background_.count() < kMaxAtWork && background_.run(work)) return;
  waiting_.erase(call);
  fail(asked, service);
}

void GatewayLink::act(std::uint8_t action) {
  const Answer asked = {vehicle_, "action", actionWords(action)};
  call<Action>("action", asked, actionOf(action).request,
               [this, asked](const Action::Response& response) { take(asked, response.status); });
}

template <class Service, class Command>
void GatewayLink::sendMotion(const std::string& name, Command command) {
  typename Service::Request request;
  request.command = std::move(command);
  request.command.header.stamp = ros::Time::now();
  const bool is_dry_run = request.command.dry_run;
  const QString what = serviceWords(name) + (is_dry_run ? ", dry run" : "");
  const Answer asked = {vehicle_, name, what};
  const int connection = connection_;
  call<Service>(name, asked, request, [this, asked, is_dry_run, connection](const typename Service::Response& response) {
    CommandStatus status = response.status;
    const std::string report = reportWords(response.report).toStdString();
    if (!report.empty()) status.message += (status.message.empty() ? "" : "; ") + report;
    take(asked, status);
    const bool is_shown = is_dry_run && connection == connection_;
    if (is_shown && response.status.status != CommandStatus::ERROR) Q_EMIT pathPlanned(response.path);
  });
}

void GatewayLink::send(const LaneFollowCommand& command) { sendMotion<LaneFollow>("lane_follow", command); }
void GatewayLink::send(const FreeSpaceCommand& command) { sendMotion<FreeSpace>("free_space", command); }
void GatewayLink::send(const PathFollowCommand& command) { sendMotion<PathFollow>("path_follow", command); }
void GatewayLink::send(const ValetParkingCommand& command) { sendMotion<ValetParking>("valet_parking", command); }
void GatewayLink::send(const PreciseParkingCommand& command) { sendMotion<PreciseParking>("precise_parking", command); }
void GatewayLink::send(const ZoneCoverCommand& command) { sendMotion<ZoneCover>("zone_cover", command); }

void GatewayLink::send(const SpeedCommand& command) {
  Speed::Request request;
  request.command = command;
  request.command.header.stamp = ros::Time::now();
  const Answer asked = {vehicle_, "speed", "speed"};
  call<Speed>("speed", asked, request,
              [this, asked](const Speed::Response& response) { take(asked, response.status); });
}

void GatewayLink::find(const FindMapObjects::Request& wanted) {
  const Answer asked = {vehicle_, "map_objects", "look into the map"};
  const int connection = connection_;
  call<FindMapObjects>("map_objects", asked, wanted,
                       [this, connection, wanted](const FindMapObjects::Response& response) {
                         if (connection == connection_) Q_EMIT objectsFound(wanted, response);
                       });
}

void GatewayLink::findVehicles() {
  background_.run([this]() -> Background::Job {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    std::set<std::string> found;
    for (const ros::master::TopicInfo& topic : topics) {
      const std::size_t place = topic.name.rfind(kStatusTopic);
      if (place != std::string::npos && place + std::string(kStatusTopic).size() == topic.name.size()) {
        found.insert(place == 0 ? "/" : topic.name.substr(0, place));
      }
    }
    return [this, vehicles = std::vector<std::string>(found.begin(), found.end())] { Q_EMIT vehiclesFound(vehicles); };
  });
}

void GatewayLink::take(const Answer& asked, const CommandStatus& status) {
  Q_EMIT answered(withStatus(asked, status));
  if (hasEnded(status) || asked.vehicle != vehicle_) return;
  running_[status.command_id] = asked;
  const auto ended = ended_.find(status.command_id);
  if (ended != ended_.end()) {  // before the answer came
    takeStatus(CommandStatus(ended->second));
  } else if (isMotion(asked.service)) {
    state_.motion = status;
    Q_EMIT stateChanged();
  }
}

void GatewayLink::fail(Answer asked, const std::string& service) {
  asked.words = QString("no answer from %1: is the gateway running, and is this its namespace?")
                    .arg(QString::fromStdString(service));
  Q_EMIT answered(asked);
}

/// Tells where a call has no answer for long.
void GatewayLink::watch(int call, const Answer& asked) {
  waiting_.insert(call);
  QTimer::singleShot(kPatience, this, [this, call, asked] {
    if (waiting_.count(call) == 0) return;
    Answer late = asked;
    late.words = QString("no answer for %1 s; still waiting").arg(kPatience / 1000);
    Q_EMIT answered(late);
  });
}

void GatewayLink::takeNews() {
  if (!topics_) return;
  const GatewayTopics::News news = topics_->take();
  bool has_changed = news.readiness || news.progress || news.chassis || state_.chassis;
  state_.chassis = news.chassis;
  if (news.readiness) state_.readiness = news.readiness;
  if (news.progress) state_.motion = news.progress;
  for (const CommandStatus& status : news.statuses) {
    takeStatus(status);
    has_changed = true;
  }
  if (has_changed) Q_EMIT stateChanged();
}

/// A change of a command's status: told where the command was sent from here, or is the one that is driven.
void GatewayLink::takeStatus(const CommandStatus& status) {
  const auto known = running_.find(status.command_id);
  const bool is_driven = state_.motion && state_.motion->command_id == status.command_id;
  if (is_driven) state_.motion = status;  // no other: dry runs have statuses, too
  if (!hasEnded(status)) {
    ended_.erase(status.command_id);
    return;
  }
  ended_[status.command_id] = status;
  if (ended_.size() > kMaxEnded) ended_.erase(ended_.begin());
  if (known != running_.end()) {
    Q_EMIT answered(withStatus(known->second, status));
    running_.erase(known);
  } else if (is_driven) {
    Q_EMIT answered(withStatus({vehicle_, status.service, serviceWords(status.service)}, status));
  }
}

void GatewayLink::publishDraft(const visualization_msgs::MarkerArray& markers) {
  draft_ = markers;
  if (topics_) topics_->publishDraft(markers);
}

void GatewayLink::lookAt(double x, double y) {
  if (!topics_) return;
  geometry_msgs::PointStamped place;
  place.header.stamp = ros::Time::now();
  place.point.x = x;
  place.point.y = y;
  topics_->publishLookAt(place);
}

}  // namespace external_command
