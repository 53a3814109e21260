// SPDX-License-Identifier: Apache-2.0
#include "bend_relief.h"

#include <algorithm>
#include <cmath>

#include "path_shape.h"
#include "smoothing.h"

namespace external_command {

namespace {

constexpr double kMargin = 15.0;        // on either side of a hard place, in which the path may prepare for it [m]
constexpr double kBaseScale = 3.0;      // over which the line that offsets are measured from is smoothed [m]
constexpr std::size_t kHeld = 3;        // points at either end of a window that stay
constexpr std::size_t kRamp = 8;        // points over which the smoother line takes the place of the path there
constexpr double kMerging = 0.05;       // off the course, where the path has yet to get onto it [m]
constexpr double kMergingRoom = 0.5;    // beyond its limits that it may take there [m]
constexpr double kNearLimit = 0.97;     // share of the vehicle's curvature that is aimed at
constexpr double kNoticeable = 0.3;     // by which the front swings out before it is looked at [m]
constexpr double kFrontMayLeave = 0.1;  // the lane, before anything is done about it [m]

/// Of points `step` [m] apart, the ends left out.
std::vector<double> curvaturesOf(const std::vector<Point2d>& points, double step) {
  std::vector<double> kappas(points.size(), 0.0);
  const double scale = 1.0 / (step * step * step);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    kappas[i] = scale * cross(points[i] - points[i - 1], points[i + 1] - points[i]);
  }
  return kappas;
}

/// Points of the curve through points[begin] ... points[end], both included, about `step` apart, without the first.
class Resampler {
 public:
  explicit Resampler(const std::vector<Point2d>& points) : points_(points) {}

  /// Calls add(position, share of the way from point i to the next, i).
  template <class Add>
  void sample(std::size_t begin, std::size_t end, double step, Add&& add) const {
    std::vector<double> s(end - begin + 1, 0.0);
    for (std::size_t i = begin + 1; i <= end; ++i) s[i - begin] = s[i - begin - 1] + lengthOf(i - 1);
    const auto count = static_cast<std::size_t>(std::max(1.0, std::round(s.back() / step)));
    std::size_t i = begin;
    for (std::size_t k = 1; k < count; ++k) {
      const double wanted = s.back() * static_cast<double>(k) / static_cast<double>(count);
      while (i + 1 < end && s[i + 1 - begin] < wanted) ++i;
      add(at(i, (wanted - s[i - begin]) / std::max(s[i + 1 - begin] - s[i - begin], 1e-9)), i);
    }
    add(points_[end], end);
  }

 private:
  /// Of length 1.
  Point2d tangentAt(std::size_t i) const {
    const std::size_t last = points_.size() - 1;
    if (i == 0 || i == last) return (points_[i == 0 ? 1 : last] - points_[i == 0 ? 0 : last - 1]).normalized();
    // Of the circle through the point and its neighbours: the nearer side weighs more.
    const Point2d in = points_[i] - points_[i - 1], out = points_[i + 1] - points_[i];
    const Point2d sum = in / std::max(in.squaredNorm(), 1e-12) + out / std::max(out.squaredNorm(), 1e-12);
    return sum.normalized();
  }

  double lengthOf(std::size_t i) const {
    const double turn = std::abs(cross(tangentAt(i), tangentAt(i + 1)));
    return (points_[i + 1] - points_[i]).norm() * (1.0 + turn * turn / 24.0);
  }

  /// On the cubic Hermite piece from point `i` to the next.
  Point2d at(std::size_t i, double u) const {
    const Point2d chord = points_[i + 1] - points_[i];
    const double length = lengthOf(i), v = 1.0 - u;
    return points_[i] + u * u * (3.0 - 2.0 * u) * chord + length * u * v * (v * tangentAt(i) - u * tangentAt(i + 1));
  }

  const std::vector<Point2d>& points_;
};

}  // namespace

bool BendRelief::isHard(std::size_t place, double kappa, double next_kappa) const {
  const double limit = kNearLimit * vehicle_.maxKappa();
  if (std::abs(kappa) > limit) return true;
  if (std::abs(next_kappa - kappa) > fastestChangeOfKappa(vehicle_) * step_) return true;
  const double front = vehicle_.wheelbase + vehicle_.front_overhang;
  if (0.5 * std::abs(kappa) * front * front < kNoticeable) return false;
  return corridor_.frontExcess(course_[place], kappa) > kFrontMayLeave;
}

std::vector<BendRelief::Window> BendRelief::windowsOf(const CourseLayout& layout) const {
  const std::vector<double> kappas = curvaturesOf(layout.points, step_);
  const auto margin = static_cast<std::size_t>(std::ceil(kMargin / step_));
  const std::size_t count = layout.points.size();
  // Where the lane bends too much already at an end of the path, only the place is kept there.
  const double limit = kNearLimit * vehicle_.maxKappa();
  const bool keeps_start = layout.starts_at_pose || std::abs(kappas[layout.first]) < limit;
  const bool keeps_goal = std::abs(kappas[layout.last]) < limit;
  std::vector<Window> windows;
  for (std::size_t i = layout.first; i <= layout.last; ++i) {
    const double next = kappas[std::min(i + 1, layout.last)];
    if (!isHard(layout.places[i], kappas[i], next) && !(layout.starts_at_pose && i == layout.first)) continue;
    Window window{i < margin ? 0 : i - margin, std::min(i + margin, count - 1), true, true};
    window.keeps_begin = window.begin > layout.first || keeps_start;
    window.keeps_end = window.end < layout.last || keeps_goal;
    if (!windows.empty() && window.begin <= windows.back().end + 1) {
      windows.back().end = window.end;
      windows.back().keeps_end = window.keeps_end;
    } else {
      windows.push_back(window);
    }
  }
  return windows;
}

/// The line that offsets are measured from: smoother than the path, so that its normals do not cross nearby.
std::vector<Point2d> BendRelief::baseOf(const CourseLayout& layout, const Window& window) const {
  const auto begin = layout.points.begin() + static_cast<std::ptrdiff_t>(window.begin);
  const std::vector<Point2d> path(begin, layout.points.begin() + static_cast<std::ptrdiff_t>(window.end + 1));
  std::vector<Point2d> base = path;
  const std::size_t first = std::max(layout.first, window.begin) - window.begin;
  const std::size_t last = std::min(layout.last, window.end) - window.begin;
  smooth(kBaseScale / step_, first, last, &base);
  const auto ramp = [](std::size_t from_end) { return std::max(0.0, static_cast<double>(from_end) - 2.0) / kRamp; };
  for (std::size_t i = 0; i < base.size(); ++i) {
    double share = 1.0;
    if (window.keeps_begin) share = std::min(share, ramp(i > first ? i - first : 0));
    if (window.keeps_end) share = std::min(share, ramp(i < last ? last - i : 0));
    base[i] = path[i] + share * (base[i] - path[i]);
  }
  return base;
}

std::vector<Point2d> BendRelief::fitted(const CourseLayout& layout, const Window& window,
                                        const CancelToken& cancel) const {
  const std::vector<Point2d> base = baseOf(layout, window);
  std::vector<FitPoint> fit(base.size());
  for (std::size_t i = 0; i < base.size(); ++i) {
    const Point2d way = base[std::min(i + 1, base.size() - 1)] - base[i == 0 ? 0 : i - 1];
    const std::size_t index = window.begin + i, place = layout.places[index];
    fit[i].base = base[i];
    fit[i].normal = Point2d(-way.y(), way.x()).normalized();
    fit[i].center = (wished_[place] - base[i]).dot(fit[i].normal);
    corridor_.limit(course_[place], &fit[i]);
    fit[i].wished_low = std::min(fit[i].wished_low, fit[i].center);
    fit[i].wished_high = std::max(fit[i].wished_high, fit[i].center);
    // A vehicle that stands beside the lane needs some room to get back into it.
    const double room = (wished_[place] - course_[place].position).norm() > kMerging ? kMergingRoom : 0.0;
    fit[i].low = std::min(fit[i].low, fit[i].wished_low - room);
    fit[i].high = std::max(fit[i].high, fit[i].wished_high + room);
    const bool is_before = window.begin > layout.first ? i < kHeld : index < layout.first;
    const bool is_beyond = window.end < layout.last ? i + kHeld >= base.size() : index > layout.last;
    const bool is_end = index == layout.first || index == layout.last;
    fit[i].fixed = is_end || (is_before && window.keeps_begin) || (is_beyond && window.keeps_end);
  }
  PathFit path(std::move(fit), {step_, kNearLimit * vehicle_.maxKappa(), kNearLimit * fastestChangeOfKappa(vehicle_),
                                vehicle_.wheelbase + vehicle_.front_overhang, vehicle_.rear_overhang});
  path.run(cancel);
  return path.points();
}

void BendRelief::apply(const CancelToken& cancel, CourseLayout* layout) const {
  const std::vector<Window> windows = windowsOf(*layout);
  if (windows.empty()) return;
  CourseLayout relieved;
  relieved.starts_at_pose = layout->starts_at_pose;
  std::size_t next = 0;  // of the points not taken over yet
  const auto add = [&](const Point2d& point, std::size_t index) {
    if (index == layout->first) relieved.first = relieved.points.size();
    if (index == layout->last) relieved.last = relieved.points.size();
    relieved.points.push_back(point);
    relieved.places.push_back(layout->places[index]);
  };
  for (const Window& window : windows) {
    for (; next < window.begin; ++next) add(layout->points[next], next);
    const std::vector<Point2d> points = fitted(*layout, window, cancel);
    const Resampler resampler(points);
    add(points.front(), window.begin);
    std::size_t from = 0;
    for (const std::size_t knot : {layout->first, layout->last, window.end}) {
      if (knot <= window.begin + from || knot > window.end) continue;
      const std::size_t to = knot - window.begin;
      resampler.sample(from, to, step_, [&](const Point2d& point, std::size_t i) {
        // Only the knots themselves are the ends of the path.
        const std::size_t index = window.begin + i;
        const bool is_end = i != to && (index == layout->first || index == layout->last);
        add(point, is_end ? index + 1 : index);
      });
      from = to;
    }
    next = window.end + 1;
  }
  for (; next < layout->points.size(); ++next) add(layout->points[next], next);
  *layout = std::move(relieved);
}

}  // namespace external_command
