// SPDX-License-Identifier: Apache-2.0
#include "work.h"

#include <algorithm>
#include <cmath>

namespace external_command {

Work::Work(std::vector<Curve> ways) : reversible_(ways.size() == 2) {
  for (const Curve& way : ways) add(way);
}

Work Work::closed(const Curve& loop, double spacing) {
  Work work;
  work.addClosed(loop, spacing);
  return work;
}

void Work::add(const Curve& way) {
  entries_.push_back({curves_.size(), 0.0});
  curves_.push_back(way);
  starts_.push_back(way.start);
  ends_.push_back(way.end());
}

void Work::addClosed(const Curve& loop, double spacing) {
  const double length = loop.length();
  const int n = std::clamp(static_cast<int>(length / spacing), 1, kMostEntries);
  Pose2d pose = loop.start;
  double driven = 0.0;
  std::size_t arc = 0;
  for (int i = 0; i < n; ++i) {
    const double offset = length * i / n;
    while (arc + 1 < loop.arcs.size() && driven + std::abs(loop.arcs[arc].length) <= offset) {
      driven += std::abs(loop.arcs[arc].length);
      pose = advance(pose, loop.arcs[arc++]);
    }
    if (loop.arcs[arc].length < 0.0) continue;  // not while backing up
    entries_.push_back({curves_.size(), offset});
    starts_.push_back(advance(pose, loop.arcs[arc], offset - driven));
    ends_.push_back(starts_.back());
  }
  curves_.push_back(loop);
}

bool Work::operator==(const Work& other) const {
  const auto isSamePose = [](const Pose2d& a, const Pose2d& b) {
    return a.x == b.x && a.y == b.y && a.heading == b.heading;
  };
  const auto isSameArc = [](const ArcSegment& a, const ArcSegment& b) {
    return a.length == b.length && a.kappa == b.kappa;
  };
  const auto isSameCurve = [&](const Curve& a, const Curve& b) {
    return isSamePose(a.start, b.start) &&
           std::equal(a.arcs.begin(), a.arcs.end(), b.arcs.begin(), b.arcs.end(), isSameArc);
  };
  return lap == other.lap && is_ring == other.is_ring &&
         std::equal(starts_.begin(), starts_.end(), other.starts_.begin(), other.starts_.end(), isSamePose) &&
         std::equal(curves_.begin(), curves_.end(), other.curves_.begin(), other.curves_.end(), isSameCurve);
}

Curve Work::curveOf(std::size_t way) const {
  const Entry& entry = entries_[way];
  const Curve& curve = curves_[entry.curve];
  if (entry.offset <= 0.0) return curve;
  Curve result = partOf(curve, entry.offset, curve.length());
  result.append(partOf(curve, 0.0, entry.offset).arcs);
  return result;
}

}  // namespace external_command
