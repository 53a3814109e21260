// SPDX-License-Identifier: Apache-2.0
#include "random_drives.h"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "external_command/core/error.h"
#include "external_command/core/vehicle.h"
#include "external_command/routing/lane_way_tool.h"
#include "external_command/routing/reference_paths.h"
#include "external_command/routing/router.h"

namespace external_command {

namespace {

constexpr int kDrives = 4;
constexpr double kOff = 3.0;  // of poses from centre lines, at most [m]

class Drives {
 public:
  Drives(const std::shared_ptr<const HdMap>& map, std::mt19937* random)
      : map_(*map), random_(*random), lanes_(*map, {}), router_(map, {}), paths_(map, {}, {}) {}

  std::size_t run() {
    std::size_t paths = 0;
    for (int i = 0; i < kDrives; ++i) {
      try {
        drive();
        ++paths;
      } catch (const Error& error) {
        if (error.code() == ErrorCode::kInternalError) throw;
      }
    }
    return paths;
  }

 private:
  void drive() {
    const Pose2d start = pose();
    RouteQuery query;
    query.starts = lanes_.fromVehicle(start);
    if (happens(0.3)) query.via.push_back(lanes_.fromPose(pose().position(), std::nullopt, "way_point[0]"));
    query.goals = goals();
    if (happens(0.3)) query.black_list.push_back(part());
    const Route route = router_.findRoute(query, CancelToken());
    toSegments(map_, route);
    ReferencePathQuery wish;
    if (happens(0.5)) wish.start = start;
    paths_.find(route, wish);
  }

  std::vector<LanePoint> goals() {
    const std::size_t spaces = map_.parkingSpaces().size();
    if (spaces > 0 && happens(0.3)) {
      bool used_geometry = false;
      return lanes_.fromParkingSpace(map_.parkingSpaces()[below(spaces)].id, &used_geometry);
    }
    const Pose2d goal = pose();
    return lanes_.fromPose(goal.position(), happens(0.5) ? std::optional(goal.heading) : std::nullopt, "end_pose");
  }

  /// On a lane or near one.
  Pose2d pose() {
    const Lane& lane = map_.lanes()[below(map_.lanes().size())];
    Pose2d pose = lane.center.poseAt(share() * lane.length());
    if (happens(0.5)) return pose;
    pose.x += (2.0 * share() - 1.0) * kOff;
    pose.y += (2.0 * share() - 1.0) * kOff;
    pose.heading += 2.0 * share() - 1.0;
    return pose;
  }

  LaneRange part() {
    const auto lane = static_cast<LaneIndex>(below(map_.lanes().size()));
    const double length = map_.lane(lane).length(), from = share() * length;
    return {lane, from, from + share() * (length - from)};
  }

  double share() { return std::uniform_real_distribution<double>()(random_); }
  bool happens(double probability) { return share() < probability; }
  std::size_t below(std::size_t limit) { return std::uniform_int_distribution<std::size_t>(0, limit - 1)(random_); }

  const HdMap& map_;
  std::mt19937& random_;
  const LaneWayTool lanes_;
  const Router router_;
  const ReferencePaths paths_;
};

}  // namespace

std::size_t driveAbout(const std::shared_ptr<const HdMap>& map, std::mt19937* random) {
  return Drives(map, random).run();
}

}  // namespace external_command
