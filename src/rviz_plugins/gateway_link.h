// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <QObject>
#include <QTimer>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "background.h"
#include "external_command/FindMapObjects.h"
#include "external_command/FreeSpaceCommand.h"
#include "external_command/LaneFollowCommand.h"
#include "external_command/PathFollowCommand.h"
#include "external_command/PlannedPath.h"
#include "external_command/PreciseParkingCommand.h"
#include "external_command/SpeedCommand.h"
#include "external_command/ValetParkingCommand.h"
#include "external_command/ZoneCoverCommand.h"
#include "gateway_state.h"
#include "gateway_topics.h"
#include "stop_line.h"

namespace external_command {

/// A gateway as a panel needs it. Nothing here waits for ROS: calls are made on threads of their own, and answered by
/// signals in the thread of this object. A STOP waits for nothing that was called before.
class GatewayLink : public QObject {
  Q_OBJECT
 public:
  explicit GatewayLink(QObject* parent = nullptr);
  ~GatewayLink() override;

  /// From now on the gateway in this namespace; what is known of another one is forgotten.
  void connectTo(const std::string& vehicle);

  const std::string& vehicle() const { return vehicle_; }
  const GatewayState& state() const { return state_; }

  void stop();
  void act(std::uint8_t action);  ///< a constant of ActionCommand
  void send(const LaneFollowCommand& command);
  void send(const FreeSpaceCommand& command);
  void send(const PathFollowCommand& command);
  void send(const ValetParkingCommand& command);
  void send(const PreciseParkingCommand& command);
  void send(const ZoneCoverCommand& command);
  void send(const SpeedCommand& command);

  void find(const FindMapObjects::Request& wanted);

  /// Looks for gateways of the ROS master: vehiclesFound().
  void findVehicles();

  /// Shown in rviz by a display of `external_command/draft`.
  void publishDraft(const visualization_msgs::MarkerArray& markers);

  /// A place of the map that somebody looks at [m].
  void lookAt(double x, double y);

 Q_SIGNALS:
  void stateChanged();
  void answered(const external_command::Answer& answer);
  void pathPlanned(const external_command::PlannedPath& path);  ///< of a dry run
  void objectsFound(const external_command::FindMapObjects::Request& wanted,
                    const external_command::FindMapObjects::Response& found);
  void vehiclesFound(const std::vector<std::string>& vehicles);

 private:
  template <class Service>
  using Reply = std::function<void(const typename Service::Response&)>;

  template <class Service>
  void call(const std::string& name, const Answer& asked, const typename Service::Request& request,
            const Reply<Service>& reply);
  template <class Service, class Command>
  void sendMotion(const std::string& name, Command command);
  void take(const Answer& asked, const CommandStatus& status);
  void fail(Answer asked, const std::string& service);
  void watch(int call, const Answer& asked);
  void lookForGateway();
  void forgetCommands();
  void askWhatRuns();
  void takeNews();
  void takeStatus(const CommandStatus& status);
  std::string nameOf(const std::string& service) const;

  std::string vehicle_;
  GatewayState state_;
  std::shared_ptr<StopLine> stop_line_;
  std::shared_ptr<GatewayTopics> topics_;  ///< nullptr until they are subscribed
  std::optional<visualization_msgs::MarkerArray> draft_;
  int connection_ = 0;  ///< number of the connectTo(): what comes of an earlier one is dropped
  int last_call_ = 0;
  std::set<int> waiting_;                        ///< calls without an answer
  std::map<std::int64_t, Answer> running_;       ///< commands that were sent from here
  std::map<std::int64_t, CommandStatus> ended_;  ///< the last statuses; an end may come before the answer
  bool is_looking_ = false;
  QTimer news_timer_, look_timer_;
  Background background_{this};  // last: its work ends with nobody to follow it up before the rest goes
};

}  // namespace external_command
