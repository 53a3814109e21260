// SPDX-License-Identifier: Apache-2.0
#include "way_pose_search.h"

#include <algorithm>
#include <cmath>

#include "search_box.h"

namespace external_command {

namespace {

constexpr std::size_t kLines = 6;          ///< that are tried
constexpr std::size_t kSpareLegs = 12;     ///< that may fail on one line
constexpr std::size_t kLegSteps = 12'000;  ///< of the search for one leg
constexpr double kShortestLeg = 4.0;       ///< in turning radii; ends need room to manoeuvre
constexpr double kLongestLeg = 9.0;        ///< in turning radii
constexpr double kEnds = 1.5;              ///< around start and goal, in turning radii
constexpr double kTangent = 3.0;           ///< over which the line's direction is taken, to either side [m]
constexpr double kEnoughRoom = 4.0;        ///< more does not make a place better [m]
constexpr double kRoomAround = 3.0;        ///< of a leg, in turning radii

double distance(const GuidePoint& a, const GuidePoint& b) { return (a.at - b.at).norm(); }

/// Length of the line up to each of its points.
std::vector<double> lengthsOf(const std::vector<GuidePoint>& line) {
  std::vector<double> lengths{0.0};
  for (std::size_t i = 1; i < line.size(); ++i) lengths.push_back(lengths.back() + distance(line[i - 1], line[i]));
  return lengths;
}

}  // namespace

WayPoseSearch::WayPoseSearch(const Scene& scene, const Query& query, const BoundingBox& area)
    : scene_(scene), query_(query), area_(area) {}

bool WayPoseSearch::run(const std::function<bool()>& stop) {
  stop_ = stop;
  GuideMap guide(scene_.index, area_, stop_);
  for (std::size_t tried = 0; tried < kLines && !stop_(); ++tried) {
    const std::vector<GuidePoint> line = guide.way(query_.start.position(), query_.goal.position());
    if (line.empty()) return false;
    const std::vector<WayPlace> places = placesOn(line);
    if (places.size() < 2) return false;
    farthest_ = 0;
    tries_ = places.size() + kSpareLegs;
    Arcs arcs;
    if (follow(line, places, 0, query_.start, &arcs)) {
      arcs_ = merged(arcs);
      return true;
    }
    // every line leads through the surroundings of start and goal
    std::size_t first = farthest_ == 0 ? 0 : places[farthest_ - 1].index, last = places[farthest_].index + 1;
    const double ends = kEnds * scene_.radius;
    while (first < last && (line[first].at - query_.start.position()).norm() < ends) ++first;
    while (first < last && (line[last - 1].at - query_.goal.position()).norm() < ends) --last;
    if (first == last) return false;
    guide.close(line, first, last);
  }
  return false;
}

/// Places a few turning radii apart, each where there is most room; the last one is the goal.
std::vector<WayPoseSearch::WayPlace> WayPoseSearch::placesOn(const std::vector<GuidePoint>& line) const {
  const std::vector<double> lengths = lengthsOf(line);
  const double shortest = kShortestLeg * scene_.radius, longest = kLongestLeg * scene_.radius;
  std::vector<WayPlace> places;
  double done = 0.0;
  while (lengths.back() - done > shortest + longest) {
    WayPlace best{0, {}};
    double best_room = -1.0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      if (lengths[i] < done + shortest || lengths[i] > done + longest) continue;
      const double room = std::min(line[i].room, kEnoughRoom);
      if (room < best_room) continue;
      WayPlace place = placeAt(line, i);
      if (!place.poses.empty()) best = std::move(place), best_room = room;
    }
    if (best.poses.empty()) {
      done += shortest;
      continue;
    }
    done = lengths[best.index];
    places.push_back(std::move(best));
  }
  places.push_back({line.size() - 1, {query_.goal}});
  return places;
}

WayPoseSearch::WayPlace WayPoseSearch::placeAt(const std::vector<GuidePoint>& line, std::size_t index) const {
  std::size_t before = index, after = index;
  while (before > 0 && distance(line[before], line[index]) < kTangent) --before;
  while (after + 1 < line.size() && distance(line[after], line[index]) < kTangent) ++after;
  const Point2d along = line[after].at - line[before].at;
  const double heading = std::atan2(along.y(), along.x());
  WayPlace place{index, {}};
  for (const double turned : {0.0, M_PI}) {
    // the vehicle's middle on the line, so that it stands in the middle of a lane whichever way it points
    const double ahead = turned == 0.0 ? 0.0 : scene_.index.box().centre * 2.0;
    const Point2d at = line[index].at + ahead * unitVector(heading);
    const Pose2d pose{at.x(), at.y(), normalizeAngle(heading + turned)};
    if (scene_.index.isFree(pose)) place.poses.push_back(pose);
  }
  return place;
}

/// Depth first: along the line where that is possible, else against it.
bool WayPoseSearch::follow(const std::vector<GuidePoint>& line, const std::vector<WayPlace>& places, std::size_t next,
                           const Pose2d& from, Arcs* arcs) {
  if (next == places.size()) return true;
  const std::size_t first = next == 0 ? 0 : places[next - 1].index;
  for (const Pose2d& to : places[next].poses) {
    if (tries_ == 0 || stop_()) return false;
    --tries_;
    farthest_ = std::max(farthest_, next);
    const std::size_t before = arcs->size();
    if (searchLeg(from, to, next + 1 == places.size(), line, first, places[next].index, arcs) &&
        follow(line, places, next + 1, to, arcs)) {
      return true;
    }
    arcs->resize(before);
  }
  return false;
}

bool WayPoseSearch::searchLeg(const Pose2d& from, const Pose2d& to, bool is_last, const std::vector<GuidePoint>& line,
                              std::size_t first, std::size_t last, Arcs* arcs) const {
  std::vector<Point2d> points{from.position(), to.position()};
  for (std::size_t i = first; i <= last; ++i) points.push_back(line[i].at);
  const BoundingBox box = searchBox(points, kRoomAround * scene_.radius, area_);
  Junctions junctions;
  junctions.after = is_last ? query_.junctions.after : 0;
  TwoWaySearch search(scene_, {from, to, junctions}, box);
  const double infinity = std::numeric_limits<double>::infinity();
  if (search.run({}, {kLegSteps, infinity, stop_}) != TwoWaySearch::Outcome::kFound) return false;
  arcs->insert(arcs->end(), search.arcs().begin(), search.arcs().end());
  return true;
}

}  // namespace external_command
