// SPDX-License-Identifier: Apache-2.0
#include "route_path.h"

#include <algorithm>

#include "external_command/core/text.h"
#include "route_sections.h"

namespace external_command {

namespace {

constexpr double kMerging = 43.0;  // in which a vehicle beside its lane gets onto it [m]

/// The route is as good as a point: the path stands there, in the lane's direction, or where the vehicle is.
Path standingPath(const HdMap& map, const Route& route, const std::optional<Pose2d>& start) {
  Path path;
  if (start) {
    path.push_back({start->x, start->y, start->heading});
    path.push_back(path.front());
    return path;
  }
  for (const auto& [lane, s] : {std::pair(route.steps.front().lane, route.steps.front().from_s),
                                std::pair(route.steps.back().lane, route.steps.back().to_s)}) {
    const Pose2d pose = map.lane(lane).center.poseAt(s);
    path.push_back({pose.x, pose.y, pose.heading});
  }
  path.back().s = (path[1].pose().position() - path[0].pose().position()).norm();
  return path;
}

using SectionPath = std::shared_ptr<const ReferencePath>;

class RoutePath {
 public:
  RoutePath(const PathMaking& making, const ReferencePathQuery& query, SectionMemory* memory)
      : making_(making), query_(query), memory_(memory) {}

  ReferencePath of(const std::vector<RouteRow>& rows) const {
    const auto cuts_of = [this](LaneIndex lane) { return cutsOf(lane); };
    const std::vector<PathSection> sections = sectionsOf(rows, query_.start ? kMerging : 0.0, cuts_of);
    std::vector<SectionPath> parts;
    for (const PathSection& section : sections) parts.push_back(partOf(section));
    return joined(parts);
  }

 private:
  std::shared_ptr<const LaneCuts> cutsOf(LaneIndex lane) const {
    if (memory_ == nullptr) return std::make_shared<const LaneCuts>(laneCuts(making_, lane));
    if (auto known = memory_->cuts.find(lane)) return known;
    auto made = std::make_shared<const LaneCuts>(laneCuts(making_, lane));
    memory_->cuts.keep(lane, made, 4 + made->places.size());
    return made;
  }

  SectionPath partOf(const PathSection& section) const {
    const bool is_first = !section.follows;
    if (memory_ == nullptr || !section.isPlain()) return made(section, is_first ? query_.start : std::nullopt);
    const SectionKey key{section.rows.front().pieces};
    if (auto known = memory_->paths.find(key)) return known;
    auto part = made(section, std::nullopt);
    memory_->paths.keep(key, part, part->path.size());
    return part;
  }

  SectionPath made(const PathSection& section, const std::optional<Pose2d>& start) const {
    return std::make_shared<const ReferencePath>(sectionPath(making_, section, start, query_.cancel));
  }

  ReferencePath joined(const std::vector<SectionPath>& parts) const {
    std::size_t count = 0;
    for (const SectionPath& part : parts) count += part->path.size();
    ReferencePath whole;
    whole.path.reserve(count);
    for (const SectionPath& part : parts) append(*part, &whole);
    if (query_.target_speed > 0.0) {
      for (ReferencePoint& point : whole.path) point.speed = std::min(point.speed, query_.target_speed);
    }
    return whole;
  }

  /// The place where two parts meet is the first of the later one.
  static void append(const ReferencePath& part, ReferencePath* whole) {
    if (part.path.empty()) return;
    const std::size_t meeting = whole->path.empty() ? 0 : whole->path.size() - 1;
    const double driven = whole->path.empty() ? 0.0 : whole->path.back().s;
    const double cap = whole->path.empty() ? part.path.front().speed : whole->path.back().speed;
    whole->path.resize(meeting);
    whole->path.insert(whole->path.end(), part.path.begin(), part.path.end());
    whole->path[meeting].speed = std::min(whole->path[meeting].speed, cap);
    for (std::size_t i = meeting; i < whole->path.size(); ++i) whole->path[i].s += driven;
    whole->tight.insert(whole->tight.end(), part.tight.begin(), part.tight.end());
    whole->left.insert(whole->left.end(), part.left.begin(), part.left.end());
  }

  const PathMaking& making_;
  const ReferencePathQuery& query_;
  SectionMemory* const memory_;
};

}  // namespace

ReferencePath routePath(const PathMaking& making, const Route& route, const ReferencePathQuery& query,
                        SectionMemory* memory) {
  query.cancel.throwIfCancelled();
  ReferencePath path = RoutePath(making, query, memory).of(rowsOf(route));
  if (path.path.empty()) return {standingPath(making.map, route, query.start), {}, {}};
  if (making.params.refuse_undrivable && !path.tight.empty()) {
    throw NoPath(describe(making.map, path.tight, making.vehicle).front() +
                 "; such paths are refused (~routing/refuse_undrivable)");
  }
  return path;
}

}  // namespace external_command
