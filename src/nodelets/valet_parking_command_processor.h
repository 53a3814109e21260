// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "external_command/ValetParking.h"
#include "nodelets/manoeuvres/parking_manoeuvres.h"
#include "nodelets/manoeuvres/parking_poses.h"

namespace external_command {

/// Drives along the lanes to a parking space of the map and parks in it.
class ValetParkingCommandProcessor : public MotionCommandProcessor<ValetParking> {
 public:
  ValetParkingCommandProcessor();
  ~ValetParkingCommandProcessor() override;

 private:
  void start() override;
  void check(const ValetParkingCommand& command) const override;
  std::optional<RoutingTask> convert(const ValetParkingCommand& command, const PlanStart& start) override;
  bool takesOver() const override { return true; }
  void processSpecialCommand(const ValetParkingCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  void reportSmallSpaces() const;
  const ParkingSpace& spaceOf(const ValetParkingCommand& command) const;
  ParkingSpot spotIn(const ParkingSpace& space) const;
  RoutingTask taskTo(const ValetParkingCommand& command, const PlanStart& start,
                     std::vector<LanePoint> candidates) const;
  std::vector<LanePoint> otherLanes(const ParkingSpace& space, const std::vector<LanePoint>& known) const;
  /// Keeps the route that it finds. @return false where there is none.
  bool findRoute(RoutingTask* task) const;

  /// Replaces the end of the route by the way into the space, and its begin where the vehicle is parked.
  void park(const ValetParkingCommand& command, const Deadline& deadline, const CancelToken& cancel,
            MotionPlan* plan) const;

  /// The same by a route to a lane alongside, where `why` stands against the one that was taken; false where none does.
  bool parkFromOtherLane(const ValetParkingCommand& command, const std::string& why, const Deadline& deadline,
                         const CancelToken& cancel, MotionPlan* plan) const;

  std::vector<Pose2d> freePosesIn(const ParkingSpace& space, const MotionPlan& plan, const CancelToken& cancel) const;

  std::optional<ManoeuvrePlanner> planner_;
  ParkingParams params_;
};

}  // namespace external_command
