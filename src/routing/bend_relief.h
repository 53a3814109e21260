// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "corridor.h"

namespace external_command {

/// The points of a path over its course.
struct CourseLayout {
  std::vector<Point2d> points;
  std::vector<std::size_t> places;  ///< the place on the course that each point belongs to
  std::size_t first = 0, last = 0;  ///< between which the path lies; the points beyond serve as neighbours
  bool starts_at_pose = false;      ///< the points up to `first` stay where they are
};

/// Where a path leaves its course to be drivable.
class BendRelief {
 public:
  /// @param course  places `step` [m] apart. @param wished  where the path would like to be at each of them.
  BendRelief(const Corridor& corridor, const VehicleParams& vehicle, double step,
             const std::vector<CoursePoint>& course, const std::vector<Point2d>& wished)
      : corridor_(corridor), vehicle_(vehicle), step_(step), course_(course), wished_(wished) {}

  /// Moves points where the path bends too tightly or too fast, or leads the front of the vehicle out of its lane. New
  /// points there are as far apart as before, about.
  /// @throws Cancelled
  void apply(const CancelToken& cancel, CourseLayout* layout) const;

 private:
  struct Window {
    std::size_t begin, end;       ///< first and last point
    bool keeps_begin, keeps_end;  ///< with the headings there
  };

  std::vector<Window> windowsOf(const CourseLayout& layout) const;
  bool isHard(std::size_t place, double kappa, double next_kappa) const;
  std::vector<Point2d> baseOf(const CourseLayout& layout, const Window& window) const;
  std::vector<Point2d> fitted(const CourseLayout& layout, const Window& window, const CancelToken& cancel) const;

  const Corridor& corridor_;
  const VehicleParams& vehicle_;
  const double step_;
  const std::vector<CoursePoint>& course_;
  const std::vector<Point2d>& wished_;
};

}  // namespace external_command
