// SPDX-License-Identifier: Apache-2.0
#include "bays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "coverage/path/side_step.h"

namespace external_command {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kShiftStep = 0.05;  ///< between shifts that are tried [m]

class BayFinder {
 public:
  BayFinder(const Field& field, const Pose2d& start, double step) : field_(field), start_(start), step_(step) {}

  std::vector<Bay> find(double from, double to) {
    const int n = std::max(1, static_cast<int>(std::ceil((to - from) / step_)));
    const auto at = [&](int i) { return from + (to - from) * i / n; };
    int begin = -1;
    for (int i = 0; i <= n + 1; ++i) {
      const bool is_free = i > n || isFree(at(i), 0.0);
      if (!is_free && begin < 0) begin = i;
      if (!is_free || begin < 0) continue;
      add(begin > 0 ? at(begin - 1) : -kInfinity, i <= n ? at(i) : kInfinity);
      begin = -1;
    }
    return std::move(bays_);
  }

 private:
  bool isFree(double along, double aside) const { return field_.isFree(placeBeside(start_, along, aside)); }

  void add(double from, double to) {
    Bay bay{from, to, shiftPast(from, to)};
    if (bays_.empty() || !bay.isPassable() || !bays_.back().isPassable() || hasRoom(bays_.back(), bay)) {
      bays_.push_back(bay);
      return;
    }
    const Bay both{bays_.back().from, to, shiftPast(bays_.back().from, to)};
    if (both.isPassable()) {
      bays_.back() = both;
    } else {
      bay.shift = 0.0;
      bays_.push_back(bay);
    }
  }

  bool hasRoom(const Bay& before, const Bay& bay) const {
    return before.to + SideStep(bay.shift - before.shift, field_.radius()).along < bay.from;
  }

  /// The smallest one to either side; 0 if there is none.
  double shiftPast(double from, double to) const {
    if (!std::isfinite(from) || !std::isfinite(to)) return 0.0;
    for (double shift = kShiftStep; shift <= field_.mostShift(); shift += kShiftStep) {
      for (const double aside : {shift, -shift}) {
        if (isFree(from, to, aside)) return aside;
      }
    }
    return 0.0;
  }

  bool isFree(double from, double to, double aside) const {
    double along = from;
    while (along <= to && isFree(along, aside)) along += step_;
    return along > to;
  }

  const Field& field_;
  Pose2d start_;
  double step_;
  std::vector<Bay> bays_;
};

}  // namespace

Pose2d placeBeside(const Pose2d& start, double along, double aside) {
  const Point2d ahead = unitVector(start.heading);
  const Point2d at = start.position() + along * ahead + aside * Point2d(-ahead.y(), ahead.x());
  return {at.x(), at.y(), start.heading};
}

std::vector<Bay> baysOf(const Field& field, const Pose2d& start, double length, double step) {
  const double nose = std::max(0.0, field.front() - field.vehicle().rear_overhang);
  return BayFinder(field, start, step).find(-nose, length);
}

}  // namespace external_command
