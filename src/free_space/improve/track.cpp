// SPDX-License-Identifier: Apache-2.0
#include "track.h"

#include <algorithm>
#include <cmath>

namespace external_command {

Track::Track(const Query& query, const Arcs& arcs, const DrivingCost& cost) : arcs_(arcs), junctions_(query.junctions) {
  const CostModel& model = cost.ofArcs();
  Pose2d pose = query.start;
  double s = 0.0, so_far = costBefore(arcs_, model, junctions_);
  for (std::size_t i = 0; i < arcs_.size(); ++i) {
    if (i > 0) so_far += model.between(arcs_[i - 1], arcs_[i]);
    begins_.push_back(pose);
    s_.push_back(s);
    costs_.push_back(so_far);
    driving_.push_back(model.ofArc(arcs_[i].length) + cost.ofCloseness(pose, arcs_[i]));
    pose = advance(pose, arcs_[i]);
    s += std::abs(arcs_[i].length);
    so_far += driving_.back();
  }
  s_.push_back(s);
  costs_.push_back(so_far + costAfter(arcs_, model, junctions_));
}

std::size_t Track::arcAt(double s) const {
  const auto next = std::upper_bound(s_.begin(), s_.end() - 1, s);
  return next == s_.begin() ? 0 : static_cast<std::size_t>(next - s_.begin()) - 1;
}

Track::Place Track::placeAt(std::size_t arc, double s) const {
  const ArcSegment& here = arcs_[arc];
  const double length = std::abs(here.length), driven = std::clamp(s - s_[arc], 0.0, length);
  const double cost = costs_[arc] + (length > 0.0 ? driven / length * driving_[arc] : 0.0);
  return {advance(begins_[arc], here, driven), gearOf(here), here.kappa, cost, arc, s_[arc] + driven};
}

Track::Place Track::arriving(double s) const {
  if (s <= 0.0) return {begins_[0], junctions_.before, junctions_.kappa_before, 0.0, 0, 0.0};
  const std::size_t arc = arcAt(s);
  return placeAt(arc > 0 && s <= s_[arc] ? arc - 1 : arc, s);
}

Track::Place Track::leaving(double s) const {
  Place place = placeAt(arcAt(s), s);
  if (s >= length()) place.gear = junctions_.after, place.kappa = junctions_.kappa_after, place.cost = cost();
  return place;
}

Arcs Track::spliced(const Place& from, const Arcs& middle, const Place& to) const {
  Arcs result(arcs_.begin(), arcs_.begin() + static_cast<std::ptrdiff_t>(from.arc));
  const ArcSegment &first = arcs_[from.arc], &last = arcs_[to.arc];
  result.push_back({std::copysign(from.s - s_[from.arc], first.length), first.kappa});
  result.insert(result.end(), middle.begin(), middle.end());
  result.push_back({std::copysign(s_[to.arc + 1] - to.s, last.length), last.kappa});
  result.insert(result.end(), arcs_.begin() + static_cast<std::ptrdiff_t>(to.arc) + 1, arcs_.end());
  return merged(result);
}

}  // namespace external_command
