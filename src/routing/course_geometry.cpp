// SPDX-License-Identifier: Apache-2.0
#include "course_geometry.h"

#include <algorithm>
#include <cmath>

#include "path_shape.h"

namespace external_command {

namespace {

constexpr double kTiny = 1e-6;               // [m]
constexpr std::size_t kPollInterval = 4096;  // samples between two looks at the cancel token
constexpr double kFullLock = 0.9;            // share of the vehicle's curvature that a smooth change may take

/// The way from 0 to 1 on two circular arcs, for a change of `length` over `offset` [m].
double twoArcs(double t, double length, double offset) {
  const double radius = (length * length + offset * offset) / (4.0 * offset);
  const double x = length * std::min(t, 1.0 - t);
  const double share = (radius - std::sqrt(std::max(0.0, radius * radius - x * x))) / offset;
  return t < 0.5 ? share : 1.0 - share;
}

}  // namespace

CoursePoint CourseGeometry::Walker::at(double s) {
  while (next_ + 1 < line_->s.size() && line_->s[next_] < s) ++next_;
  const double from = line_->s[next_ - 1], to = line_->s[next_];
  const double share = to > from ? std::clamp((s - from) / (to - from), 0.0, 1.0) : 1.0;
  const Point2d& begin = line_->points[next_ - 1];
  const LanePoint& end = line_->lanes[next_];
  const LanePoint lane{end.lane, std::max(0.0, end.s - (1.0 - share) * (to - from))};
  return {begin + share * (line_->points[next_] - begin), line_->limits[next_], lane, lane};
}

CourseGeometry::CourseGeometry(const HdMap& map, const std::vector<RouteRow>& rows, double lead_in, double lead_out,
                               const VehicleParams& vehicle, const ReferencePathParams& params) {
  for (const RouteRow& row : rows) {
    lines_.push_back(courseLine(map, row, &row == &rows.front() ? lead_in : 0.0, &row == &rows.back() ? lead_out : 0.0,
                                params.default_speed_limit));
  }
  double done = 0.0;  // on the line of the row
  for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
    const double end = lines_[r].end;
    const double leave = std::max(done, end - (rows[r].length - rows[r].leave));
    const double share = std::min(1.0, params.lane_change_length / std::max(rows[r + 1].onto, kTiny));
    addAlong(r, done, leave);
    done = share * rows[r + 1].onto;
    addAcross(r, leave, leave + share * (end - leave), done, kFullLock * vehicle.maxKappa());
  }
  addAlong(rows.size() - 1, std::min(done, lines_.back().end), lines_.back().end);
}

void CourseGeometry::addAlong(std::size_t line, double from, double to) {
  const double begin = stretches_.empty() ? 0.0 : length();
  stretches_.push_back({line, from, to, 0.0, 0.0, false, begin, begin + to - from, {}});
}

void CourseGeometry::addAcross(std::size_t line, double from, double to, double onto_to, double max_kappa) {
  std::vector<Walker> walkers = this->walkers();
  const double offset = (walkers[line].at(from).position - walkers[line + 1].at(0.0).position).norm();
  Stretch stretch{line, from, to, onto_to, offset, false, length(), length(), {}};
  stretch.in_arcs = kQuinticPeak * offset > max_kappa * stretch.ahead() * stretch.ahead();
  Point2d last = across(stretch, 0.0, &walkers).position;
  for (std::size_t part = 1; part <= kParts; ++part) {
    const Point2d next = across(stretch, static_cast<double>(part) / kParts, &walkers).position;
    stretch.reached[part] = stretch.reached[part - 1] + (next - last).norm();
    last = next;
  }
  stretch.end += stretch.reached.back();
  stretches_.push_back(stretch);
}

std::vector<CoursePoint> CourseGeometry::sample(double step, std::size_t before, std::size_t after,
                                                const CancelToken& cancel) const {
  std::vector<Walker> walkers = this->walkers();
  std::vector<CoursePoint> points;
  points.reserve(before + 1 + after);
  auto stretch = stretches_.begin();
  for (std::size_t i = 0; i <= before + after; ++i) {
    if (i % kPollInterval == 0) cancel.throwIfCancelled();
    const double x = step * (static_cast<double>(i) - static_cast<double>(before));
    while (x > stretch->end && stretch + 1 != stretches_.end()) ++stretch;
    const double driven = x - stretch->begin;
    if (stretch->onto_to <= 0.0 || driven < 0.0) {
      points.push_back(walkers[stretch->line].at(stretch->from + driven));
      continue;
    }
    const auto next = std::upper_bound(stretch->reached.begin() + 1, stretch->reached.end() - 1, driven);
    const double share = (driven - *(next - 1)) / std::max(*next - *(next - 1), kTiny);
    const double part = static_cast<double>(next - 1 - stretch->reached.begin()) + share;
    points.push_back(across(*stretch, std::min(part / kParts, 1.0), &walkers));
  }
  return points;
}

/// The place at the share `t` of the way across.
CoursePoint CourseGeometry::across(const Stretch& stretch, double t, std::vector<Walker>* walkers) const {
  const double share = stretch.in_arcs ? twoArcs(t, stretch.ahead(), stretch.offset) : quintic(t);
  const CoursePoint from = (*walkers)[stretch.line].at(stretch.from + t * (stretch.to - stretch.from));
  const CoursePoint onto = (*walkers)[stretch.line + 1].at(t * stretch.onto_to);
  return {from.position + share * (onto.position - from.position), std::min(from.speed_limit, onto.speed_limit),
          from.lane, onto.lane};
}

}  // namespace external_command
