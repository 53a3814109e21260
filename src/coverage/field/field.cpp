// SPDX-License-Identifier: Apache-2.0
#include "field.h"

#include <algorithm>
#include <cmath>

#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "grid_obstacles.h"

namespace external_command {

namespace {

constexpr double kCheckStep = 0.1;       ///< most that a corner moves between two checks [m]
constexpr double kMaxCells = 2.5e6;      ///< of the grid; sets its finest cell
constexpr double kCellsPerSwath = 12.0;  ///< across
constexpr double kMaxExtent = 20e3;      ///< of the area [m]
constexpr double kMostWidths = 1600.0;  ///< from corner to corner: memory and time of a look at the swaths grow with it
constexpr double kKept = 0.99;          ///< share of the goal, at least, that lies within the free part
constexpr double kMostShift = 1.5;      ///< [swath widths]
constexpr double kUnwanted = 5000.0;    ///< price of a change of gear for a vehicle that is not to reverse [m]

Region regionOf(const CoverageArea& area, const CoverageParams& params, const Point2d& origin,
                const Checkpoint& checkpoint) {
  Region::Parts parts;
  parts.limits = area.limits;
  parts.drivable = area.outer.movedBy(-origin);
  for (const Polygon& hole : area.holes) parts.non_drivable.push_back(hole.movedBy(-origin));
  if (area.grid) {
    for (const Polygon& obstacle : gridObstacles(*area.grid, area.outer, params.max_grid_rows, checkpoint)) {
      parts.non_drivable.push_back(obstacle.movedBy(-origin));
    }
  }
  return Region(std::move(parts));
}

Point2d originOf(const CoverageArea& area, double swath_width) {
  const BoundingBox& box = area.outer.box();
  const Point2d size = box.max - box.min;
  if (size.maxCoeff() > kMaxExtent) {
    throw InvalidRequest(text(area.outer.name(), " is ", metres(size.maxCoeff()), " across; at most ",
                              metres(kMaxExtent), " can be planned: divide it"));
  }
  if (size.norm() > kMostWidths * swath_width) {
    throw InvalidRequest(text(area.outer.name(), " is ", metres(size.norm()),
                              " from corner to corner; with a swath_width of ", metres(swath_width), " at most ",
                              metres(kMostWidths * swath_width), " can be planned: divide it"));
  }
  return {std::round(box.min.x()), std::round(box.min.y())};
}

/// Every eighth pose first, then those between: a way that is not free shows that soon.
template <class IsFree>
bool allFree(const Curve& curve, double reach, const IsFree& isFree) {
  if (!isFree(curve.start)) return false;
  std::vector<EvenArc> arcs;
  Pose2d begin = curve.start;
  for (const ArcSegment& arc : curve.arcs) {
    arcs.emplace_back(begin, arc, reach, kCheckStep);
    begin = arcs.back().pose(arcs.back().steps());
    if (!isFree(begin)) return false;
  }
  for (const int first : {4, 8, 2, 6, 1, 3, 5, 7}) {
    for (const EvenArc& arc : arcs) {
      for (int i = first; i < arc.steps(); i += 8) {
        if (!isFree(arc.pose(i))) return false;
      }
    }
  }
  return true;
}

}  // namespace

Field::Field(const VehicleParams& vehicle, const CoverageParams& params, const CoverageArea& area,
             const std::optional<Pose2d>& start, const CancelToken& cancel)
    : vehicle_(vehicle),
      params_(params),
      cancel_(cancel),
      origin_(originOf(area, params.swath_width)),
      reach_(
          std::hypot(std::max(vehicle.wheelbase + vehicle.front_overhang, vehicle.rear_overhang), vehicle.width / 2.0)),
      region_(regionOf(area, params, origin_, checkpoint())),
      checker_(vehicle, params.margin, region_, checkpoint()),
      bare_checker_(vehicle, 0.0, region_, checkpoint()) {
  if (start) start_ = Pose2d{start->x - origin_.x(), start->y - origin_.y(), start->heading};
  setShapes(area);
  setGoal();
  setPassable();
  requireFreeStart(area);
}

void Field::poll() const {
  cancel_.throwIfCancelled();
  if (timeUsed() < 1.0) return;
  throw PlanningTimeout(text("the area was not planned within ", seconds(params_.time_budget),
                             " (time_budget); give it more time, or divide the area"));
}

double Field::gearPrice() const {
  return params_.reverse_to_turn ? params_.gear_change_cost : std::max(params_.gear_change_cost, kUnwanted);
}

double Field::timeUsed() const {
  const std::chrono::duration<double> used = std::chrono::steady_clock::now() - began_;
  return used.count() / params_.time_budget;
}

/// Beyond that, a swath is better ended: too much is left beside it.
double Field::mostShift() const { return std::min(kMostShift * width(), radius()); }

void Field::setShapes(const CoverageArea& area) {
  const shapes::Shapes whole = only(shapeOf(region_.drivable()->points()));
  std::vector<shapes::Shapes> holes;
  for (const Polygon& hole : region_.nonDrivable()) holes.push_back(only(shapeOf(hole.points())));
  free_ = difference(whole, unionOf(holes, checkpoint()));
  if (!free_.empty()) return;
  for (std::size_t i = 0; i < area.holes.size(); ++i) {
    if (!difference(whole, holes[i]).empty()) continue;
    throw InvalidRequest(
        text(area.holes[i].name(), " leaves nothing of the area of ", std::round(area.outer.area()), " m^2"));
  }
  throw InvalidRequest(text("the ", area.holes.size(), " polygons non_drivable_roi",
                            area.grid ? " and the obstacle grid" : "", " together leave nothing of the area of ",
                            std::round(area.outer.area()), " m^2"));
}

void Field::requireFreeStart(const CoverageArea& area) {
  if (!start_) return;
  if (!start_->isFinite()) throw InvalidRequest("the start pose is not finite");
  const Pose2d given{start_->x + origin_.x(), start_->y + origin_.y(), start_->heading};
  const auto collision = bare_checker_.collisionAt(*start_);
  if (!collision) {
    const auto close = checker_.collisionAt(*start_);
    if (!close) return;
    start_warning_ = text("at the start ", at(given), " the footprint is nearer to ",
                          close->kind == Collision::Kind::kNonDrivable ? "" : "the border of ", close->obstacle,
                          " than the margin of ", metres(params_.margin), ", ", close->extent(),
                          "; it leaves with a smaller margin");
    return;
  }
  const Region region({area.outer, area.holes, area.grid, std::nullopt, area.limits});
  throw StartBlocked(text("at the start ", at(given), " the footprint ", collision->description(),
                          unknownCellsHint(vehicle_, 0.0, region, given, checkpoint()),
                          "; move the vehicle into the free area"));
}

void Field::setGoal() {
  const double tool = params_.swath_width / 2.0, half = std::max(vehicle_.width / 2.0, tool);
  const shapes::Shapes core = grown(free_, -half, checkpoint());
  if (core.empty()) {
    const BoundingBox& box = region_.drivable()->box();
    throw InvalidRequest(text("the area is smaller than the vehicle: in its ", metres(box.max.x() - box.min.x()), " x ",
                              metres(box.max.y() - box.min.y()), " there is no place for a circle of ",
                              metres(2.0 * half), " (the larger of vehicle width and swath_width)"));
  }
  shapes::Shapes part;
  if (start_) {
    part = partAt(core, start_->position());
  } else {
    const auto smaller = [](const auto& a, const auto& b) { return areaOf(only(a)) < areaOf(only(b)); };
    part = only(*std::max_element(core.begin(), core.end(), smaller));
  }
  const shapes::Shapes swept = grown(part, tool, checkpoint());
  goal_ = intersection(swept, free_);
  // It lies within the free part but for rounding, so that their borders run along each other: Boost.Geometry may lose
  // the area then.
  if (areaOf(goal_) < kKept * areaOf(swept)) goal_ = swept;
  workable_ = partAt(free_, part.front().outer().front());
}

void Field::setPassable() {
  const auto isSmall = [&](const shapes::Ring& hole) {
    const double size = perimeterOf(shapeOf(pointsOf(hole))) / (2.0 * M_PI);
    return size + width() / 2.0 < radius() && size + vehicle_.width / 2.0 + params_.margin < mostShift();
  };
  passable_ = workable_;
  for (shapes::Shape& shape : passable_) {
    auto& holes = shape.inners();
    holes.erase(std::remove_if(holes.begin(), holes.end(), isSmall), holes.end());
  }
}

bool Field::isFree(const Curve& curve) const {
  return allFree(curve, reach_, [&](const Pose2d& pose) { return checker_.isFree(pose); });
}

bool Field::isBarelyFree(const Curve& curve) const {
  return allFree(curve, reach_, [&](const Pose2d& pose) { return bare_checker_.isFree(pose); });
}

Curve Field::freePart(const Curve& curve, double step) const {
  const double length = curve.length();
  const int n = std::max(1, static_cast<int>(std::ceil(length / step)));
  const std::vector<Pose2d> poses = evenPoses(curve, n);
  int begin = -1, longest = 0, longest_begin = 0;
  for (int i = 0; i <= n + 1; ++i) {
    poll();
    const bool free = i <= n && isFree(poses[static_cast<std::size_t>(i)]);
    if (free && begin < 0) begin = i;
    if (free || begin < 0) continue;
    if (i - 1 - begin > longest) longest = i - 1 - begin, longest_begin = begin;
    begin = -1;
  }
  return partOf(curve, length * longest_begin / n, length * (longest_begin + longest) / n);
}

CoverageGrid Field::makeGrid() const {
  const BoundingBox& box = region_.drivable()->box();
  const Point2d size = box.max - box.min;
  CoverageGrid grid(box, std::max(width() / kCellsPerSwath, std::sqrt(size.x() * size.y() / kMaxCells)));
  grid.set(free_, kFree);
  grid.set(goal_, kGoal);
  const double half = vehicle_.width / 2.0 + params_.margin;
  grid.set(grown(free_, -half, checkpoint()), kOpen);
  grid.set(grown(passable_, -half, checkpoint()), kPassable);
  return grid;
}

}  // namespace external_command
