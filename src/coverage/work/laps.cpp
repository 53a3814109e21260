// SPDX-License-Identifier: Apache-2.0
#include "laps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "access.h"
#include "corner.h"
#include "external_command/core/polyline.h"
#include "ring.h"

namespace external_command {

namespace {

constexpr double kTighter = 0.97;      ///< laps bend a little less than the vehicle can, to leave room for rounding
constexpr double kSwingRoom = 0.02;    ///< besides the margin, for rounding [m]
constexpr double kMinSide = 0.3;       ///< shorter sides only disturb [m]
constexpr double kEntrySpacing = 1.0;  ///< between places at which a closed lap may begin [m]
constexpr double kPoseStep = 0.2;      ///< [m]
constexpr std::array<double, 3> kAhead = {1.0, 3.0, 6.0};  ///< as followRound()
constexpr double kBlocked = -1e-3;  ///< turn of a corner that is none but for something in the way [rad]

/// A lap along one ring.
class LapBuilder {
 public:
  /// @param slants  as CornerSearch.
  LapBuilder(const Field& field, double price, CoverageGrid* grid, const Ring& ring, bool slants)
      : field_(field), price_(price), grid_(*grid), ring_(ring), slants_(slants) {}

  std::vector<Work> build() {
    if (ring_.bends().empty()) {
      if (auto round = roundLap()) return {*round};
    }
    findSides();
    findWays();
    return chain();
  }

 private:
  double maxKappa() const { return kTighter * field_.vehicle().maxKappa(); }

  /// The ring bends gently everywhere: driven as it is, either way round; or its vertices are cut a little, where the
  /// nose would not get round them.
  std::optional<Work> roundLap() const {
    for (const double ahead : kAhead) {
      field_.poll();
      if (auto work = roundLap(ahead)) return work;
    }
    return std::nullopt;
  }

  std::optional<Work> roundLap(double ahead) const {
    const Curve curve = curveRound(ahead);
    std::optional<Work> work;
    for (const Curve& way : {curve, turnedRound(curve)}) {
      if (!field_.isFree(way)) continue;
      if (work) {
        work->addClosed(way, kEntrySpacing);
      } else {
        work = Work::closed(way, kEntrySpacing);
      }
    }
    return work;
  }

  /// Cuts the ring at its bends, and each part to where the vehicle is free. A bend that follows another with no side
  /// between them counts as one with it.
  void findSides() {
    const auto& bends = ring_.bends();
    if (bends.empty()) findSidesRound();
    double turn_before_all = 0.0;
    for (std::size_t i = 0; i < bends.size(); ++i) {
      const bool last = i + 1 == bends.size();
      const Ring::Bend& next = bends[last ? 0 : i + 1];
      const double from = bends[i].end, to = next.begin + (last ? ring_.length() : 0.0);
      if (to - from > kMinSide) addSides(lineOf(bends[i], next, from, to));
      if (sides_.empty()) {
        turn_before_all += next.turn;
      } else if (corners_.size() < sides_.size()) {
        corners_.push_back({ring_.poseAt((next.begin + next.end) / 2.0), next.turn});
      } else {
        corners_.back().turn += next.turn;
      }
    }
    if (!corners_.empty()) corners_.back().turn += turn_before_all;
  }

  /// Of a ring that bends gently everywhere, but with something in the way: cut at the fewest places.
  void findSidesRound() {
    std::vector<Side> sides;
    std::vector<Corner> corners;
    for (const double ahead : kAhead) {
      sides_.clear();
      corners_.clear();
      addSides(curveRound(ahead));
      if (sides_.empty() || (!sides.empty() && sides.size() <= sides_.size())) continue;
      sides = sides_;
      corners = corners_;
      corners.push_back({ring_.poseAt(0.0), kBlocked});
    }
    sides_ = std::move(sides);
    corners_ = std::move(corners);
  }

  Curve curveRound(double ahead) const {
    return followRound(Polyline(ring_.part(0.0, 1.2 * ring_.length())), ring_.length(), maxKappa(), ahead);
  }

  /// The side between two bends, prolonged into the corners.
  Polyline lineOf(const Ring::Bend& bend, const Ring::Bend& next, double from, double to) const {
    std::vector<Point2d> points = ring_.part(from, to);
    const Point2d first = (points[1] - points[0]).normalized();
    const Point2d last = (points.back() - points[points.size() - 2]).normalized();
    if (bend.turn > 0.0) points.insert(points.begin(), points.front() - field_.width() * first);
    if (next.turn > 0.0) points.push_back(points.back() + field_.width() * last);
    return Polyline(std::move(points));
  }

  void addSides(const Polyline& line) { addSides(follow(line, 0.0, line.length(), maxKappa())); }

  /// The free parts of `whole`. What blocks it between two of them is passed like an edge of the border.
  void addSides(const Curve& whole) {
    const double length = whole.length();
    const int n = std::max(1, static_cast<int>(std::ceil(length / kPoseStep)));
    const std::vector<Pose2d> poses = evenPoses(whole, n);
    int begin = -1;
    for (int i = 0; i <= n + 1; ++i) {
      field_.poll();
      const bool free = i <= n && field_.isFree(poses[static_cast<std::size_t>(i)]);
      if (free && begin < 0) begin = i;
      if (free || begin < 0) continue;
      const double from = length * begin / n, to = length * (i - 1) / n;
      begin = -1;
      if (to - from < kMinSide) continue;
      if (corners_.size() < sides_.size()) corners_.push_back({poseAt(whole, from), kBlocked});
      sides_.push_back({partOf(whole, from, to), to - from});
    }
  }

  void findWays() {
    CornerSearch search(field_, &grid_, price_, slants_);
    ways_.resize(sides_.size());
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      field_.poll();
      const std::size_t next = (i + 1) % sides_.size();
      Side before = sides_[i];
      const double entered = i > 0 && ways_[i - 1] && !ways_[i - 1]->fills ? ways_[i - 1]->enter : 0.0;
      before.curve = partOf(before.curve, entered, before.length);
      before.length -= entered;
      Side after = sides_[next];
      if (next < i && ways_[next]) {  // closes the lap: the first side is left where it was found best
        after.length = ways_[next]->leave;
        after.curve = partOf(after.curve, 0.0, after.length);
      }
      ways_[i] = search.find(before, corners_[i], after);
      if (ways_[i]) ways_[i]->leave += entered;
      // A lone side that is left before it is entered again is no lap, but a line.
      if (next == i && ways_[i] && !ways_[i]->fills && ways_[i]->leave <= ways_[i]->enter) ways_[i].reset();
    }
  }

  /// Where side `i` is driven from, when it is come to from the side before.
  double enters(std::size_t i) const {
    const auto& way = ways_[(i + sides_.size() - 1) % sides_.size()];
    return way && !way->fills ? way->enter : 0.0;
  }

  /// Work along `count` sides, from `from` [m] on the first of them; back to where the first is entered if it `closes`.
  Curve drive(std::size_t first, double from, std::size_t count, bool closes) const {
    Curve curve{poseAt(sides_[first].curve, from), {}};
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t i = (first + k) % sides_.size();
      const bool goes_on = k + 1 < count || closes;
      curve.append(
          partOf(sides_[i].curve, k == 0 ? from : enters(i), goes_on ? ways_[i]->leave : sides_[i].length).arcs);
      if (!goes_on) continue;
      curve.append(ways_[i]->curve.arcs);
      if (!ways_[i]->fills) continue;
      curve.append(backedUp(partOf(sides_[(i + 1) % sides_.size()].curve, 0.0, ways_[i]->enter)).arcs);
    }
    return curve;
  }

  std::vector<Work> chain() const {
    const std::size_t n = sides_.size();
    std::size_t broken = n;
    for (std::size_t i = 0; i < n; ++i) {
      if (!ways_[i]) broken = i;
    }
    if (n == 0) return {};
    if (broken == n) return {closedChain()};
    std::vector<Work> works;
    for (std::size_t begin = 1, end = 1; end <= n; ++end) {  // sides after the last break, up to the next
      if (ways_[(broken + end) % n]) continue;
      const Curve way = accessiblePart(field_, drive((broken + begin) % n, 0.0, end - begin + 1, false));
      begin = end + 1;
      if (way.arcs.empty()) continue;
      const Curve back = turnedRound(way);
      works.push_back(field_.isFree(back) ? Work({way, back}) : Work(std::vector<Curve>{way}));
    }
    return works;
  }

  /// Begun anywhere; or at the beginning of a side, so that one more corner is filled.
  Work closedChain() const {
    Work work = Work::closed(drive(0, enters(0), sides_.size(), true), kEntrySpacing);
    for (std::size_t i = 0; i < sides_.size(); ++i) {
      if (enters(i) > 0.0) work.add(drive(i, 0.0, sides_.size(), true));
    }
    return work;
  }

  const Field& field_;
  double price_;
  CoverageGrid& grid_;
  const Ring& ring_;
  bool slants_;
  std::vector<Side> sides_;
  std::vector<Corner> corners_;  ///< after each side
  std::vector<std::optional<CornerWay>> ways_;
};

}  // namespace

std::vector<double> swingsOf(const Field& field) {
  if (field.params().reverse_to_turn) return {0.0};
  const double nose = std::hypot(field.radius() + field.vehicle().width / 2.0, field.front()) - field.radius();
  const double swing = nose + field.params().margin + kSwingRoom - field.width() / 2.0;
  return swing > 0.0 ? std::vector<double>{0.0, swing} : std::vector<double>{0.0};
}

std::vector<Work> planLap(const Field& field, int number, const LapRule& rule, double price, CoverageGrid* grid) {
  const double pitch = field.width() - field.params().overlap;
  const double border = field.width() / 2.0 + rule.swing + number * pitch;
  const double kept = rule.overlaps ? 0.0 : rule.around_holes * pitch;
  const double most = rule.around_holes > 0 ? field.width() / 2.0 + kept : 0.0;
  const shapes::Shapes lines = inset(field.passable(), border, std::min(border, most), field.checkpoint());
  const double inner = border + field.width() / 2.0;
  grid->clear(kInner | kOwn);
  grid->set(inset(field.passable(), inner, std::min(inner, most), field.checkpoint()), kInner);
  if (number > 0) grid->set(inset(field.passable(), border, std::min(border, most), field.checkpoint()), kOwn);
  const bool slants = !field.params().reverse_to_turn && number == 0 && rule.swing == 0.0;
  std::vector<Work> works;
  const auto add = [&](const shapes::Ring& line, bool is_ring) {
    const Ring ring(pointsOf(line), field.radius());
    if (ring.length() < field.width()) return;
    for (Work& work : LapBuilder(field, price, grid, ring, slants).build()) {
      work.lap = number;
      work.is_ring = is_ring;
      grid->sweep(work.curveOf(0), field.width());
      works.push_back(std::move(work));
    }
  };
  const auto shorter = [](const auto& a, const auto& b) { return perimeterOf(a) < perimeterOf(b); };
  const auto main = std::max_element(lines.begin(), lines.end(), shorter);
  for (auto shape = lines.begin(); shape != lines.end(); ++shape) {
    add(shape->outer(), shape != main);
    for (const auto& hole : shape->inners()) {
      if (number < rule.around_holes) add(hole, true);
    }
  }
  return works;
}

}  // namespace external_command
