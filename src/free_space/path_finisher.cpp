// SPDX-License-Identifier: Apache-2.0
#include "path_finisher.h"

#include <string>
#include <utility>

#include "external_command/core/error.h"
#include "last_check.h"
#include "steering_ramps.h"

namespace external_command {

/// A curve that is driven, and where it begins and ends.
struct PathFinisher::Drive {
  Pose2d from;
  Arcs arcs;
  Pose2d to;
  bool begins_before = false;  ///< see FreeSpacePlan
  bool ends_beyond = false;
};

struct PathFinisher::Checked {
  FreeSpacePlan plan;
  std::string fault;  ///< empty where there is none
};

PathFinisher::PathFinisher(const Scene& scene, const DrivingCost& cost, const VehicleParams& vehicle,
                           const FreeSpaceParams& params, const EndStates& ends, const StopCondition& stop)
    : scene_(scene), cost_(cost), vehicle_(vehicle), params_(params), ends_(ends), stop_(stop) {}

FreeSpacePlan PathFinisher::finish(const FoundWay& way) const {
  const std::vector<Drive> drives = drivesOf(way);
  for (const Drive& drive : drives) {
    const std::optional<Drive> gradual = withRamps(drive, way.query.start);
    if (!gradual) continue;
    if (Checked result = checked(way, *gradual); result.fault.empty()) return std::move(result.plan);
  }
  Checked result = checked(way, drives.back());
  if (!result.fault.empty()) throw NoPath("the path found failed its last check: " + result.fault);
  return std::move(result.plan);
}

/// With as many of the pieces before and after it as may be bent, where the vehicle goes over to them in gear; then
/// with fewer; the way alone comes last.
std::vector<PathFinisher::Drive> PathFinisher::drivesOf(const FoundWay& way) const {
  const Drive plain{way.query.start, merged(way.arcs), way.query.goal};
  if (plain.arcs.empty()) return {plain};
  const auto canBend = [](const EndState& end, const ArcSegment& arc) {
    return end.bend_length > 0.0 && signOf(end.direction) == gearOf(arc);
  };
  const auto piece = [](const EndState& end) { return ArcSegment{signOf(end.direction) * end.bend_length, end.kappa}; };
  const bool goes_on = !ends_.goals.empty() && ends_.goals[way.goal_index];
  const EndState* const after = goes_on ? &*ends_.goals[way.goal_index] : nullptr;
  const bool can_begin = ends_.start && canBend(*ends_.start, plain.arcs.front());
  const bool can_end = after != nullptr && canBend(*after, plain.arcs.back());
  std::vector<Drive> drives;
  for (const auto& [begins_before, ends_beyond] :
       {std::pair(true, true), {true, false}, {false, true}, {false, false}}) {
    if ((begins_before && !can_begin) || (ends_beyond && !can_end)) continue;
    Drive drive = plain;
    drive.begins_before = begins_before;
    drive.ends_beyond = ends_beyond;
    if (begins_before) drive.from = ends_.start->bend_from, drive.arcs.insert(drive.arcs.begin(), piece(*ends_.start));
    if (ends_beyond) drive.to = after->bend_from, drive.arcs.push_back(piece(*after));
    drives.push_back(std::move(drive));
  }
  return drives;
}

/// @param start  of the way: where the piece before it ends.
/// @return  nullopt where it cannot begin and end where it has to, and where steering need not be gradual.
std::optional<PathFinisher::Drive> PathFinisher::withRamps(const Drive& drive, const Pose2d& start) const {
  if (!params_.continuous_curvature) return std::nullopt;
  ExactEnds ends;
  Pose2d from = drive.from;
  if (drive.begins_before) {
    from = endOf(start, reversed({drive.arcs.front()}));
    ends.begin = drive.from;
  }
  if (drive.ends_beyond) ends.end = drive.to;
  const auto is_allowed = [this](const Pose2d& begin, const Arcs& arcs) { return keepsMargin(begin, arcs); };
  const auto stop = [this] { return stop_.isReached(); };
  const auto arcs = withSteeringRamps(from, drive.arcs, ends, vehicle_, {params_.manoeuvre_speed}, is_allowed, stop);
  if (!arcs) return std::nullopt;
  Drive result = drive;
  result.arcs = *arcs;
  return result;
}

PathFinisher::Checked PathFinisher::checked(const FoundWay& way, const Drive& drive) const {
  FreeSpacePlan plan;
  plan.path = sampleArcs(drive.from, drive.arcs, params_.spacing);
  const PathDemands demands{drive.from, drive.to, vehicle_.maxKappa(), params_.spacing};
  const LastCheck check = checkPath(plan.path, demands, scene_.index);
  plan.goal_index = way.goal_index;
  plan.begins_before = drive.begins_before;
  plan.ends_beyond = drive.ends_beyond;
  plan.cost = cost_.of(drive.from, drive.arcs, way.query.junctions);
  plan.length = lengthOf(drive.arcs);
  plan.gear_changes = gearChangesOf(drive.arcs);
  plan.wheel_turns = wheelTurnsOf(drive.arcs, scene_.radius);
  plan.near_length = cost_.nearLength(drive.from, drive.arcs);
  plan.min_clearance = check.min_clearance;
  plan.reverse_length = reverseLength(plan.path);
  return {std::move(plan), check.fault.value_or("")};
}

bool PathFinisher::keepsMargin(const Pose2d& from, const Arcs& arcs) const {
  stop_.cancel().throwIfCancelled();
  if (stop_.isReached()) return false;
  Pose2d begin = from;
  for (const ArcSegment& arc : arcs) {
    if (!scene_.index.keepsMargin(begin, arc)) return false;
    begin = advance(begin, arc);
  }
  return true;
}

}  // namespace external_command
