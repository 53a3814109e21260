// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <mutex>
#include <optional>
#include <string>

#include "external_command/ZoneCover.h"
#include "parking_manoeuvres.h"
#include "zone_plan_file.h"
#include "zone_tracker.h"

namespace external_command {

/// Sweeps an area of the map, or a polygon of the command; its status tells how far it has come.
class ZoneCoverCommandProcessor : public MotionCommandProcessor<ZoneCover> {
 public:
  ZoneCoverCommandProcessor();
  ~ZoneCoverCommandProcessor() override;

 private:
  /// A zone that is being swept.
  struct Sweep {
    AdmittedCommand command;
    ZoneTracker tracker;
    ZonePlanFile file;
    CoverageProgress progress;
    double covered_before;  ///< by earlier runs [m^2]
    double goal_area;       ///< to be covered in all [m^2]
  };

  void start() override;
  void open() override;
  void check(const ZoneCoverCommand& command) const override;
  std::optional<RoutingTask> convert(const ZoneCoverCommand& command, const PlanStart& start) override;
  double planningTime(const ZoneCoverCommand& command, const Pose2d& vehicle) const override;
  void processSpecialCommand(const ZoneCoverCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  /// With the command's own swath width, where it has one. @throws InvalidRequest
  CoverageParams paramsFor(const ZoneCoverCommand& command) const;
  const Area& areaOf(const ZoneCoverCommand& command) const;
  CoverageArea zoneOf(const ZoneCoverCommand& command) const;
  Pose2d givenStart(const ZoneCoverCommand& command, const PlanStart& start) const;
  bool isInside(const ZoneCoverCommand& command, const PlanStart& start) const;
  void enterZone(const ZoneCoverCommand& command, const CoverageArea& zone, const CancelToken& cancel,
                 MotionPlan* plan) const;
  static CoverageProgress progressOf(const ZoneCoverCommand& command, const ZonePlanFile& file);
  void appendCoverage(const CoverageResult& coverage, MotionPlan* plan) const;
  // Called by the timer and before a plan; the latter two with the mutex held.
  void track();
  void followVehicle();
  void keepDone(std::size_t count);

  std::optional<ManoeuvrePlanner> planner_;
  CoverageParams coverage_params_;
  double access_distance_ = 10.0;  ///< of lanes to areas without overlaps, at most [m]
  std::string progress_folder_ = "~/.ros/external_command";
  std::mutex sweep_mutex_;
  std::optional<Sweep> sweep_;
  DedicatedLane tracking_lane_{LaneOptions{"the lane that follows a sweep"}};  // before its timer
  ros::SteadyTimer tracking_timer_;
};

/// @throws InvalidParameter
CoverageParams readCoverageParams(const ParameterReader& reader);

}  // namespace external_command
