// SPDX-License-Identifier: Apache-2.0
#include "last_check.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kEndDistance = 1e-4;    ///< [m]
constexpr double kEndTurn = 1e-5;        ///< [rad]
constexpr double kSlip = 1e-4;           ///< [m]
constexpr double kTurnSlack = 1e-5;      ///< of a step [rad]
constexpr double kMarginSlack = 1.5e-3;  ///< [m]
constexpr double kFineStep = 4e-3;       ///< most that a corner moves between two checks at the margin [m]
constexpr double kFarthest = 10.0;       ///< clearance beyond this is not measured [m]

/// The step from one point to the next as one arc, seen from the first: exact where the path consists of arcs.
struct Step {
  double forward;
  double sideways;
  double turn;
};

Step stepBetween(const ReferencePoint& from, const ReferencePoint& to) {
  const Pose2d seen = relativeTo(from.pose(), to.pose());
  const double half = seen.heading / 2.0;
  const double scale = std::abs(half) < 1e-9 ? 1.0 : half / std::tan(half);
  return {scale * seen.x + half * seen.y, -half * seen.x + scale * seen.y, seen.heading};
}

bool isAt(const ReferencePoint& point, const Pose2d& pose) {
  return std::hypot(point.x - pose.x, point.y - pose.y) <= kEndDistance &&
         std::abs(angleBetween(point.heading, pose.heading)) <= kEndTurn;
}

std::optional<std::string> faultOf(const Step& step, const ReferencePoint& to, const PathDemands& demands) {
  const double sign = signOf(to.direction);
  if (sign * step.forward < -kSlip) return "drives against its gear";
  if (std::abs(step.sideways) > kSlip) return text("slips sideways by ", metres(std::abs(step.sideways)));
  if (std::abs(step.forward) > demands.spacing + kSlip) return text("jumps by ", metres(std::abs(step.forward)));
  const double allowed = demands.max_kappa * std::abs(step.forward) + kTurnSlack;
  if (std::abs(step.turn) > allowed) return text("turns by ", radians(step.turn), ", more than its radius allows");
  return std::nullopt;
}

/// Measures the distance to the obstacles along a path: each time the corners have moved by the room found last.
class Sweep {
 public:
  Sweep(const FootprintIndex& index, const Pose2d& begin) : index_(index) { measure(begin); }

  /// Follows one step from `from`; false where it comes too near to an obstacle or leaves the axle bounds.
  bool follow(const Pose2d& from, const Step& step) {
    const double length = std::abs(step.forward);
    if (length <= 0.0) return true;
    const ArcSegment arc{step.forward, step.turn / step.forward};
    const double corner_speed = index_.box().cornerSpeed(arc.kappa);
    double s = 0.0;
    while ((length - s) * corner_speed >= room_) {
      s += room_ / corner_speed;
      const Pose2d pose = advance(from, arc, s);
      measure(pose);
      if (clearance_.room < -kMarginSlack || !index_.isWithinAxleBounds(pose.x, pose.y)) return false;
    }
    room_ -= (length - s) * corner_speed;
    return true;
  }

  double clearance() const { return clearance_.distance; }
  double minClearance() const { return min_clearance_; }
  double minRoom() const { return min_room_; }

 private:
  void measure(const Pose2d& pose) {
    clearance_ = index_.clearance(Frame(pose), kFarthest);
    min_clearance_ = std::min(min_clearance_, clearance_.distance);
    min_room_ = std::min(min_room_, clearance_.room);
    room_ = std::max(clearance_.room, kFineStep);
  }

  const FootprintIndex& index_;
  FootprintIndex::Clearance clearance_{0.0, 0.0};
  double min_clearance_ = kFarthest;
  double min_room_ = kFarthest;
  double room_ = 0.0;  ///< how far the corners may move before the next measurement [m]
};

}  // namespace

LastCheck checkPath(const Path& path, const PathDemands& demands, const FootprintIndex& index) {
  LastCheck check;
  const auto fail = [&](const ReferencePoint& point, const std::string& what) {
    const Point2d where = point.pose().position() + index.obstacles().origin();
    check.fault = text("at ", at(where), " the path ", what);
    return check;
  };
  if (!isAt(path.front(), demands.start)) return fail(path.front(), "does not begin at the start");
  if (!isAt(path.back(), demands.goal)) return fail(path.back(), "does not end at the goal");
  Sweep sweep(index, path.front().pose());
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Step step = stepBetween(path[i - 1], path[i]);
    if (const auto fault = faultOf(step, path[i], demands)) return fail(path[i], *fault);
    if (!sweep.follow(path[i - 1].pose(), step)) {
      return fail(path[i],
                  text("comes as near as ", metres(sweep.clearance()), " to an obstacle or leaves the bounds"));
    }
  }
  check.min_clearance = sweep.minClearance();
  check.min_room = sweep.minRoom();
  return check;
}

}  // namespace external_command
