// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "external_command/ZoneCover.h"
#include "nodelets/manoeuvres/parking_manoeuvres.h"
#include "zone_keeper.h"
#include "zone_plan_file.h"
#include "zone_sweep.h"

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
    std::string path;  ///< of its file
    ZoneSweep zone;
    bool is_over = false;  ///< kept all the same: a plan that was begun before may go on with it
  };

  /// A sweep that is planned, and not sent yet.
  struct PlannedSweep {
    std::string path;  ///< of its file
    ZoneTask task;
    bool resumes;
    std::unique_ptr<ZoneKeeper::Draft> draft;
  };

  void start() override;
  void open() override;
  void check(const ZoneCoverCommand& command) const override;
  std::optional<RoutingTask> convert(const ZoneCoverCommand& command, const PlanStart& start) override;
  double planningTime(const ZoneCoverCommand& command, const Pose2d& vehicle) const override;
  bool takesOver() const override { return true; }
  void processSpecialCommand(const ZoneCoverCommand& command, const CancelToken& cancel, MotionPlan* plan) override;

  /// With the command's own swath width, where it has one. @throws InvalidRequest
  CoverageParams paramsFor(const ZoneCoverCommand& command) const;
  const Area& areaOf(const ZoneCoverCommand& command) const;
  CoverageArea zoneOf(const ZoneCoverCommand& command, const CancelToken& cancel) const;
  Pose2d givenStart(const ZoneCoverCommand& command, const PlanStart& start) const;
  bool isInside(const ZoneCoverCommand& command, const PlanStart& start) const;
  void enterZone(const ZoneCoverCommand& command, const CoverageArea& zone, const Deadline& deadline,
                 const CancelToken& cancel, MotionPlan* plan) const;
  ZonePlanFile fileOf(const ZoneCoverCommand& command, const CoverageArea& zone, const CoverageParams& params) const;
  CoverageProgress progressOf(const ZoneCoverCommand& command, const CoverageArea& zone, const CoverageParams& params,
                              const ZonePlanFile& file, const CancelToken& cancel);
  /// What a vehicle that sweeps this zone already sweeps until it is at plan.start, with points of the way there.
  std::vector<Swath> sweptUntil(const PlanStart& start, const ZonePlanFile& file);
  void appendCoverage(const CoverageResult& coverage, MotionPlan* plan) const;
  /// The sweep was sent: it replaces the one before, and its file that one's.
  void begin(PlannedSweep* planned, const SentMotion& motion);
  // Called by the timer and before a zone is resumed; the latter two with the mutex held.
  void track();
  void followVehicle();

  std::optional<ManoeuvrePlanner> planner_;
  CoverageParams coverage_params_;
  double access_distance_ = 10.0;  ///< of lanes to areas without overlaps, at most [m]
  std::string folder_;             ///< of the zones' files
  std::optional<ZoneKeeper> keeper_;
  std::mutex sweep_mutex_;
  std::optional<Sweep> sweep_;
  LogThrottle not_followed_{10.0};
  Executor tracking_executor_{ExecutorOptions{"the executor that follows a sweep"}};  // before its timer
  Periodic tracking_timer_;
};

/// @throws InvalidParameter
CoverageParams readCoverageParams(const ParameterReader& reader);

}  // namespace external_command
