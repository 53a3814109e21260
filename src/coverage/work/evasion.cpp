// SPDX-License-Identifier: Apache-2.0
#include "evasion.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "access.h"
#include "bays.h"
#include "coverage/path/side_step.h"

namespace external_command {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kApart = 1.01;  ///< of the steps before and behind a bay from the ends of a line, for rounding
/// How much of a step aside may be beside the obstacle, where its nose or tail is past it, in lengths of the vehicle.
constexpr std::array<double, 5> kTrims = {0.8, 0.65, 0.5, 0.35, 0.2};

/// A straight line with bays that can be passed, to be driven from `from` to `to` [m].
struct Slalom {
  Pose2d start;
  double from = 0.0;
  double to = 0.0;
  std::vector<Bay> bays;
};

/// Drives along one, from bay to bay.
class SlalomDriver {
 public:
  SlalomDriver(const Field& field, const Slalom& slalom) : field_(field), slalom_(slalom) {}

  Curve drive() {
    if (!slalom_.bays.empty() && !reaches(slalom_.bays.front())) aside_ = slalom_.bays.front().shift;
    along_ = slalom_.from;
    curve_ = {placeBeside(slalom_.start, along_, aside_), {}};
    for (const Bay& bay : slalom_.bays) {
      const bool is_apart = along_ + stepTo(0.0) + SideStep(bay.shift, field_.radius()).along < bay.from;
      if (along_ > slalom_.from && is_apart) goTo(along_ + stepTo(0.0), 0.0);
      goTo(bay.from - stepTo(bay.shift), aside_);
      goTo(bay.from, bay.shift);
      goTo(std::min(bay.to, slalom_.to), aside_);
    }
    if (along_ + stepTo(0.0) < slalom_.to) goTo(along_ + stepTo(0.0), 0.0);
    goTo(slalom_.to, aside_);
    return std::move(curve_);
  }

 private:
  /// Without room to step aside after its beginning, a swath begins there.
  bool reaches(const Bay& bay) const { return slalom_.from + SideStep(bay.shift, field_.radius()).along <= bay.from; }

  /// Distance ahead that it takes to get `aside` [m].
  double stepTo(double aside) const { return aside == aside_ ? 0.0 : SideStep(aside - aside_, field_.radius()).along; }

  void goTo(double along, double aside) {
    if (along <= along_) return;
    curve_.append(shortestDubins(curve_.end(), placeBeside(slalom_.start, along, aside), field_.radius()));
    along_ = along;
    aside_ = aside;
  }

  const Field& field_;
  const Slalom& slalom_;
  double along_ = 0.0;
  double aside_ = 0.0;
  Curve curve_;
};

Curve curveAlong(const Field& field, const Slalom& slalom) { return SlalomDriver(field, slalom).drive(); }

/// The bay with the vehicle aside for so short a time as it gets past.
Bay tightened(const Field& field, const Pose2d& start, Bay bay) {
  const double room = kApart * SideStep(bay.shift, field.radius()).along, length = field.vehicle().length();
  const auto isFree = [&](const Bay& some) {
    return some.from <= some.to && field.isFree(curveAlong(field, {start, some.from - room, some.to + room, {some}}));
  };
  const auto shorten = [&](double Bay::*end, double sign) {
    for (const double trim : kTrims) {
      Bay shorter = bay;
      shorter.*end += sign * trim * length;
      if (!isFree(shorter)) continue;
      bay = shorter;
      break;
    }
  };
  shorten(&Bay::from, 1.0);
  shorten(&Bay::to, -1.0);
  return bay;
}

/// nullopt where it is not free.
std::optional<Curve> wayAlong(const Field& field, const Slalom& slalom) {
  if (slalom.from >= slalom.to) return std::nullopt;
  Slalom tight = slalom;
  for (Bay& bay : tight.bays) bay = tightened(field, slalom.start, bay);
  for (Slalom some : {tight, slalom}) {
    const auto isBehind = [&](const Bay& bay) { return bay.to <= some.from; };
    some.bays.erase(std::remove_if(some.bays.begin(), some.bays.end(), isBehind), some.bays.end());
    const Curve curve = curveAlong(field, some);
    if (field.isFree(curve)) return accessiblePart(field, curve);
  }
  return std::nullopt;
}

/// The same line from its other end, `length` [m] away, between two distances from its beginning. Its bays are where
/// the footprint is the same.
Slalom fromTheOtherEnd(const Field& field, const Slalom& slalom, double length, double from, double to) {
  const double nose = field.front() - field.vehicle().rear_overhang;
  Slalom back{aboutFace(placeBeside(slalom.start, length, 0.0)),
              length - std::min(length, to + nose),
              length - std::max(0.0, from + nose),
              {}};
  for (auto bay = slalom.bays.rbegin(); bay != slalom.bays.rend(); ++bay) {
    back.bays.push_back({length - bay->to - nose, length - bay->from - nose, -bay->shift});
  }
  return back;
}

}  // namespace

std::vector<Work> evadingSwaths(const Field& field, const Pose2d& start, double length, double step) {
  std::vector<Work> works;
  Slalom slalom{start, 0.0, 0.0, {}};
  double from = -kInfinity;
  const auto addPiece = [&](double to) {
    slalom.from = std::max(0.0, from);
    slalom.to = std::min(length, to);
    std::vector<Curve> ways;
    for (const Slalom& way : {slalom, fromTheOtherEnd(field, slalom, length, from, to)}) {
      if (const std::optional<Curve> curve = wayAlong(field, way)) ways.push_back(*curve);
    }
    if (!ways.empty()) works.emplace_back(ways);
    slalom.bays.clear();
  };
  for (const Bay& bay : baysOf(field, start, length, step)) {
    if (bay.isPassable()) {
      slalom.bays.push_back(bay);
      continue;
    }
    addPiece(bay.from);
    from = bay.to;
  }
  addPiece(kInfinity);
  return works;
}

}  // namespace external_command
