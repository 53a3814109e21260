// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

#include "course_line.h"
#include "external_command/routing/reference_path.h"

namespace external_command {

/// A place on the course, and the speed limit there.
struct CoursePoint {
  Point2d position = Point2d::Zero();
  double speed_limit = 0.0;  ///< [m/s]
  LanePoint lane;            ///< that it lies on
  LanePoint onto;            ///< on a lane change: the point abreast, on the lane changed to; else the same as `lane`
};

/// The line that a route draws on the map: centre lines, and from one to the other on lane changes.
class CourseGeometry {
 public:
  /// @param lead_in, lead_out  by how much the first lane goes on before the start, and the last one after the end, at
  ///                           most, and as far as they reach [m].
  CourseGeometry(const HdMap& map, const std::vector<RouteRow>& rows, double lead_in, double lead_out,
                 const VehicleParams& vehicle, const ReferencePathParams& params);

  double length() const { return stretches_.back().end; }  ///< [m]

  /// How far the first lane goes on before the start, and the last one after the end [m].
  double leadIn() const { return lines_.front().leadIn(); }
  double leadOut() const { return lines_.back().leadOut(); }

  /// Places `step` [m] apart: `before` of them ahead of the start, the start, and `after` more.
  /// @throws Cancelled
  std::vector<CoursePoint> sample(double step, std::size_t before, std::size_t after, const CancelToken& cancel) const;

 private:
  /// Walks a line in one direction.
  class Walker {
   public:
    explicit Walker(const CourseLine& line) : line_(&line) {}
    CoursePoint at(double s);

   private:
    const CourseLine* line_;
    std::size_t next_ = 1;
  };

  static constexpr std::size_t kParts = 16;

  /// A part of the course: along one line, or across from it to the beginning of the next.
  struct Stretch {
    std::size_t line;
    double from, to;                         // on the line [m]
    double onto_to;                          // how far along the next line it leads across; 0: not at all [m]
    double offset;                           // between the two lines [m]
    bool in_arcs;                            // across in two arcs, for want of room for a smooth sweep
    double begin, end;                       // on the course [m]
    std::array<double, kParts + 1> reached;  // across: driven after each part of the way [m]

    double ahead() const { return 0.5 * (to - from + onto_to); }
  };

  void addAlong(std::size_t line, double from, double to);
  void addAcross(std::size_t line, double from, double to, double onto_to, double max_kappa);
  CoursePoint across(const Stretch& stretch, double t, std::vector<Walker>* walkers) const;
  std::vector<Walker> walkers() const { return {lines_.begin(), lines_.end()}; }

  std::vector<CourseLine> lines_;
  std::vector<Stretch> stretches_;
};

}  // namespace external_command
