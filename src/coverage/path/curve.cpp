// SPDX-License-Identifier: Apache-2.0
#include "curve.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kSagitta = 0.005;  ///< of a strip's edge [m]
constexpr int kRounds = 2;          ///< until a closed line is followed in the same way each time

/// Pure pursuit along a polyline, the progress on which never goes back.
class Follower {
 public:
  Follower(const Polyline& line, double from, double to, double max_kappa, const Pose2d& start, double ahead)
      : line_(line),
        s_(from),
        to_(to),
        max_kappa_(max_kappa),
        step_(0.1 / max_kappa),
        ahead_(ahead * 3.0 * step_),
        pose_(start) {
    curve_.start = start;
  }

  Curve drive() {
    for (int i = 0, most = static_cast<int>(3.0 * (to_ - s_) / step_) + 10; i < most && s_ < to_ - 1e-6; ++i) {
      const double length = std::min(step_, to_ - s_);
      const ArcSegment arc{length, steering()};
      curve_.append(arc);
      pose_ = advance(pose_, arc);
      catchUp(length);
    }
    return std::move(curve_);
  }

 private:
  double steering() const {
    const Point2d offset = target(s_ + ahead_) - pose_.position();
    const double lateral = cross(unitVector(pose_.heading), offset);
    const double kappa = 2.0 * lateral / std::max(offset.squaredNorm(), 1e-6);
    return std::abs(kappa) < 1e-4 * max_kappa_ ? 0.0 : std::clamp(kappa, -max_kappa_, max_kappa_);
  }

  /// Beyond the line's end it goes on straight.
  Point2d target(double s) const {
    const double beyond = s - line_.length();
    return beyond <= 0.0 ? line_.pointAt(s) : Point2d(line_.points().back() + beyond * unitVector(line_.headingAt(s)));
  }

  /// Moves the foot point on the line to where the vehicle now is, looking no farther than it has driven.
  void catchUp(double driven) {
    for (int i = 0; i < 3; ++i) {
      const Point2d along = unitVector(line_.headingAt(s_));
      const double rest = along.dot(pose_.position() - line_.pointAt(s_));
      s_ += std::clamp(rest, 0.0, driven);
    }
    s_ = std::min(s_, to_);
  }

  const Polyline& line_;
  double s_;
  double to_;
  double max_kappa_;
  double step_;   ///< [m]
  double ahead_;  ///< that the point steered for is [m]
  Pose2d pose_;
  Curve curve_;
};

}  // namespace

double Curve::length() const {
  double sum = 0.0;
  for (const ArcSegment& arc : arcs) sum += std::abs(arc.length);
  return sum;
}

unsigned Curve::gearChanges() const {
  unsigned changes = 0;
  for (std::size_t i = 1; i < arcs.size(); ++i) changes += (arcs[i].length < 0.0) != (arcs[i - 1].length < 0.0);
  return changes;
}

unsigned Curve::gearChangesBetween() const {
  if (arcs.empty()) return 0;
  return gearChanges() + (arcs.front().length < 0.0) + (arcs.back().length < 0.0);
}

void Curve::append(const ArcSegment& arc) {
  if (std::abs(arc.length) < kEmptyArc) return;
  if (!arcs.empty() && arcs.back().kappa == arc.kappa && (arcs.back().length < 0.0) == (arc.length < 0.0)) {
    arcs.back().length += arc.length;
  } else {
    arcs.push_back(arc);
  }
}

void Curve::append(const std::vector<ArcSegment>& more) {
  for (const ArcSegment& arc : more) append(arc);
}

Curve turnedRound(const Curve& curve) {
  Curve result{aboutFace(curve.end()), {}};
  for (auto arc = curve.arcs.rbegin(); arc != curve.arcs.rend(); ++arc) result.append({arc->length, -arc->kappa});
  return result;
}

Curve backedUp(const Curve& curve) {
  Curve result{curve.end(), {}};
  for (auto arc = curve.arcs.rbegin(); arc != curve.arcs.rend(); ++arc) result.append({-arc->length, arc->kappa});
  return result;
}

Curve partOf(const Curve& curve, double from, double to) {
  Curve result{poseAt(curve, from), {}};
  double s = 0.0;
  for (const ArcSegment& arc : curve.arcs) {
    const double length = std::abs(arc.length);
    const double low = std::max(from, s), high = std::min(to, s + length);
    if (high > low) result.append({std::copysign(high - low, arc.length), arc.kappa});
    s += length;
  }
  return result;
}

Pose2d poseAt(const Curve& curve, double driven) {
  Pose2d pose = curve.start;
  for (const ArcSegment& arc : curve.arcs) {
    const double length = std::abs(arc.length);
    if (driven <= length) return advance(pose, arc, std::max(driven, 0.0));
    pose = advance(pose, arc);
    driven -= length;
  }
  return pose;
}

std::vector<Pose2d> evenPoses(const Curve& curve, int n) {
  const double step = curve.length() / n;
  std::vector<Pose2d> poses;
  Pose2d begin = curve.start;
  double passed = 0.0;  // before `begin`
  for (const ArcSegment& arc : curve.arcs) {
    const double length = std::abs(arc.length);
    while (static_cast<int>(poses.size()) < n && static_cast<double>(poses.size()) * step <= passed + length) {
      poses.push_back(advance(begin, arc, static_cast<double>(poses.size()) * step - passed));
    }
    passed += length;
    begin = advance(begin, arc);
  }
  poses.resize(static_cast<std::size_t>(n) + 1, begin);
  return poses;
}

EvenArc::EvenArc(const Pose2d& begin, const ArcSegment& arc, double reach, double step)
    : begin_(begin),
      arc_(arc),
      steps_(std::max(
          1, static_cast<int>(std::ceil(std::abs(arc.length) * (1.0 + reach * std::abs(arc.kappa)) / step)))) {}

Pose2d EvenArc::pose(int i) const { return advance(begin_, arc_, std::abs(arc_.length) * i / steps_); }

std::vector<Pose2d> posesAlong(const Curve& curve, double reach, double step) {
  std::vector<Pose2d> poses{curve.start};
  Pose2d begin = curve.start;
  for (const ArcSegment& arc : curve.arcs) {
    const EvenArc even(begin, arc, reach, step);
    for (int i = 1; i <= even.steps(); ++i) poses.push_back(even.pose(i));
    begin = poses.back();
  }
  return poses;
}

Curve follow(const Polyline& line, double from, double to, double max_kappa) {
  return Follower(line, from, to, max_kappa, line.poseAt(from), 1.0).drive();
}

Curve followRound(const Polyline& line, double length, double max_kappa, double ahead) {
  Curve curve = follow(line, 0.0, length, max_kappa);
  for (int round = 0; round < kRounds; ++round) {
    curve = Follower(line, 0.0, length, max_kappa, curve.end(), ahead).drive();
  }
  return curve;
}

std::vector<std::array<Point2d, 4>> stripsOf(const Curve& curve, double width) {
  std::vector<std::array<Point2d, 4>> strips;
  const auto side = [&](const Pose2d& pose) -> Point2d {
    return 0.5 * width * Point2d(-std::sin(pose.heading), std::cos(pose.heading));
  };
  Pose2d begin = curve.start;
  for (const ArcSegment& arc : curve.arcs) {
    const double length = std::abs(arc.length), turn = std::abs(arc.kappa) * length;
    const double radius = turn > 0.0 ? 1.0 / std::abs(arc.kappa) + width / 2.0 : 0.0;
    const double most = turn > 0.0 ? std::sqrt(8.0 * kSagitta / radius) : 1.0;
    const int n = std::max(1, static_cast<int>(std::ceil(turn / most)));
    for (int i = 1; i <= n; ++i) {
      const Pose2d a = advance(begin, arc, length * (i - 1) / n), b = advance(begin, arc, length * i / n);
      strips.push_back(
          {a.position() - side(a), b.position() - side(b), b.position() + side(b), a.position() + side(a)});
    }
    begin = advance(begin, arc);
  }
  return strips;
}

}  // namespace external_command
