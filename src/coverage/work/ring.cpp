// SPDX-License-Identifier: Apache-2.0
#include "ring.h"

#include <algorithm>
#include <cmath>

namespace external_command {

namespace {

constexpr double kSamePoint = 0.01;  ///< [m]
constexpr double kSharp = 0.3;       ///< more turn than the length allows [rad]

}  // namespace

Ring::Ring(const std::vector<Point2d>& points, double radius) {
  for (const Point2d& point : points) {
    if (points_.empty() || (point - points_.back()).norm() > kSamePoint) points_.push_back(point);
  }
  while (points_.size() > 1 && (points_.front() - points_.back()).norm() <= kSamePoint) points_.pop_back();
  const std::size_t n = points_.size();
  if (n < 3) return;
  for (std::size_t i = 0; i < n; ++i) {
    const Point2d in = points_[i] - points_[(i + n - 1) % n], out = points_[(i + 1) % n] - points_[i];
    s_.push_back(length_);
    turns_.push_back(std::atan2(cross(in, out), in.dot(out)));
    length_ += out.norm();
  }
  findBends(radius, 1.0);
  findBends(radius, -1.0);
  std::sort(bends_.begin(), bends_.end(), [](const Bend& a, const Bend& b) { return a.begin < b.begin; });
}

/// Scores each vertex by its turn, less what the length up to it allows for; a bend is a run of vertices that no other
/// run beats (W. Ruzzo and M. Tompa, "A linear time algorithm for finding all maximal scoring subsequences", 1999,
/// simplified: a run ends once it has lost kSharp).
void Ring::findBends(double radius, double sign) {
  const std::size_t n = points_.size();
  std::size_t first = 0;  // begins where no run can go on: at the end of the longest edge
  double longest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    const double edge = (points_[i] - points_[(i + n - 1) % n]).norm();
    if (edge > longest) longest = edge, first = i;
  }
  double score = 0.0, peak = 0.0, turn = 0.0;
  Bend bend;
  const auto close = [&] {
    if (peak > kSharp) bends_.push_back(bend);
    score = peak = turn = 0.0;
  };
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (first + k) % n;
    const double s = s_[i] + (i < first ? length_ : 0.0);
    if (score > 0.0) score -= (points_[i] - points_[(i + n - 1) % n]).norm() / radius;
    if (score <= 0.0 || score < peak - kSharp) close();
    if (score == 0.0) bend.begin = s;
    score += sign * turns_[i];
    turn += turns_[i];
    if (score <= peak) continue;
    peak = score;
    bend.end = s;
    bend.turn = turn;
  }
  close();
}

std::vector<Point2d> Ring::part(double from, double to) const {
  std::vector<Point2d> line{poseAt(from).position()};
  const std::size_t n = points_.size();
  for (std::size_t lap = 0; lap < 3; ++lap) {
    for (std::size_t i = 0; i < n; ++i) {
      const double s = s_[i] + static_cast<double>(lap) * length_;
      if (s > from + kSamePoint && s < to - kSamePoint) line.push_back(points_[i]);
    }
  }
  line.push_back(poseAt(to).position());
  return line;
}

Pose2d Ring::poseAt(double s) const {
  const std::size_t n = points_.size();
  s -= length_ * std::floor(s / length_);
  const auto after = std::upper_bound(s_.begin(), s_.end(), s);
  const std::size_t i = static_cast<std::size_t>(after - s_.begin()) - 1;
  const Point2d &a = points_[i], &b = points_[(i + 1) % n];
  const double edge = (b - a).norm(), along = s - s_[i];
  double heading = headingOf(b - a);
  if (along < kSamePoint) heading -= turns_[i] / 2.0;
  if (edge - along < kSamePoint) heading += turns_[(i + 1) % n] / 2.0;
  const Point2d at = a + (b - a) * (along / edge);
  return {at.x(), at.y(), normalizeAngle(heading)};
}

}  // namespace external_command
