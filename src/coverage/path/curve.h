// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "external_command/core/polyline.h"
#include "external_command/core/pose.h"
#include "external_command/motion/reeds_shepp.h"

namespace external_command {

/// A way that a car can drive: arcs of constant curvature, one after the other.
struct Curve {
  Pose2d start;
  std::vector<ArcSegment> arcs;

  double length() const;
  Pose2d end() const { return external_command::advance(start, arcs); }
  unsigned gearChanges() const;

  /// Changes of gear of a vehicle that arrives at the curve and leaves it forward.
  unsigned gearChangesBetween() const;

  /// Adds an arc at the end, melted with the last where they are alike.
  void append(const ArcSegment& arc);
  void append(const std::vector<ArcSegment>& more);
};

/// The same line driven the other way, with the vehicle turned round: forward stays forward.
Curve turnedRound(const Curve& curve);

/// The same line driven backwards to its start: forward becomes reverse.
Curve backedUp(const Curve& curve);

/// The part of the curve from `from` to `to`, distances driven from its start [m].
Curve partOf(const Curve& curve, double from, double to);

/// The pose after `driven` [m] of the curve, clamped to its ends.
Pose2d poseAt(const Curve& curve, double driven);

/// `n` + 1 poses at equal distances along the curve, from its start to its end.
std::vector<Pose2d> evenPoses(const Curve& curve, int n);

inline Pose2d aboutFace(const Pose2d& pose) { return {pose.x, pose.y, normalizeAngle(pose.heading + M_PI)}; }

/// An arc in steps of equal length, so short that no corner of a vehicle that reaches `reach` [m] from its reference
/// point moves more than `step` [m] in one of them.
class EvenArc {
 public:
  EvenArc(const Pose2d& begin, const ArcSegment& arc, double reach, double step);

  int steps() const { return steps_; }

  /// After `i` steps, 0 to steps().
  Pose2d pose(int i) const;

 private:
  Pose2d begin_;
  ArcSegment arc_;
  int steps_;
};

/// Poses along the curve, its start and end among them, close enough that no corner of a vehicle that reaches `reach`
/// [m] from its reference point moves more than `step` [m] from one to the next.
std::vector<Pose2d> posesAlong(const Curve& curve, double reach, double step);

/// Drives along `line` from arc length `from` to `to` and bends no more than `max_kappa` [1/m]: each step steers for a
/// point of the line a little ahead (R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm",
/// 1992), so that what comes out can be driven exactly, and lies within centimetres of a line that bends less.
Curve follow(const Polyline& line, double from, double to, double max_kappa);

/// The same once round a closed line of `length` [m], so that the end meets the start. `line` goes on beyond it.
/// @param ahead  how far the point steered for is, as multiple of the usual: farther, the curve cuts corners more.
Curve followRound(const Polyline& line, double length, double max_kappa, double ahead);

/// Corners of the strip of `width` [m] that a straight or bent bit of work sweeps: pieces of the curve on which the
/// strip's edges stay within a centimetre of straight.
std::vector<std::array<Point2d, 4>> stripsOf(const Curve& curve, double width);

}  // namespace external_command
