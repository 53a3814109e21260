// SPDX-License-Identifier: Apache-2.0
#include "shuffle_search.h"

#include <algorithm>
#include <limits>

#include "search_box.h"

namespace external_command {

namespace {

constexpr int kWays = 3;                        ///< that are tried
constexpr int kSparePieces = 400;               ///< that may fail on one way
constexpr std::size_t kPieceSteps = 600;        ///< of the search for a piece
constexpr std::size_t kFewPoses = 4;            ///< pieces of no more are searched with ...
constexpr std::size_t kFineLevel = 3;           ///< ... short strides ...
constexpr std::size_t kFinePieceSteps = 8'000;  ///< ... and more steps
constexpr double kRoomAround = 1.0;             ///< of a piece, in turning radii

}  // namespace

ShuffleSearch::ShuffleSearch(const Scene& scene, const Query& query, const BoundingBox& area,
                             const DistanceMap& to_goal)
    : scene_(scene), query_(query), area_(area), ways_(scene_, query.start, query.goal, to_goal) {}

bool ShuffleSearch::run(const std::function<bool()>& stop) {
  stop_ = stop;
  for (int tried = 0; tried < kWays && !stop_(); ++tried) {
    const std::vector<Pose2d> way = ways_.way(stop_);
    if (way.empty()) return false;
    const std::size_t reached = follow(way);
    if (reached + 1 == way.size()) {
      arcs_ = merged(arcs_);
      return true;
    }
    ways_.avoid(way[reached + 1]);
  }
  return false;
}

/// Drives along the way, piece by piece; each is halved until it can be driven, and the next one is twice as long.
/// @return which pose of the way was reached.
std::size_t ShuffleSearch::follow(const std::vector<Pose2d>& way) {
  arcs_.clear();
  const std::size_t last = way.size() - 1;
  int failed = 0;
  for (std::size_t at = 0, piece = last; at < last; at += piece, piece *= 2) {
    piece = std::min(piece, last - at);
    while (!searchPiece(way, at, at + piece)) {
      if (piece == 1 || ++failed > kSparePieces || stop_()) return at;
      piece = (piece + 1) / 2;
    }
  }
  return last;
}

bool ShuffleSearch::searchPiece(const std::vector<Pose2d>& way, std::size_t first, std::size_t last) {
  std::vector<Point2d> points;
  for (std::size_t i = first; i <= last; ++i) points.push_back(way[i].position());
  Junctions junctions;
  junctions.after = last + 1 == way.size() ? query_.junctions.after : 0;
  TwoWaySearch search(scene_, {way[first], way[last], junctions},
                      searchBox(points, kRoomAround * scene_.radius, area_));
  TwoWaySearch::Variant variant;
  TwoWaySearch::Limits limits{kPieceSteps, std::numeric_limits<double>::infinity(), stop_};
  if (last - first <= kFewPoses) {
    variant.first_level = kFineLevel;
    limits.max_steps = kFinePieceSteps;
  }
  if (search.run(variant, limits) != TwoWaySearch::Outcome::kFound) return false;
  arcs_.insert(arcs_.end(), search.arcs().begin(), search.arcs().end());
  return true;
}

}  // namespace external_command
