// SPDX-License-Identifier: Apache-2.0
#include "path_border_checks.h"

#include <cmath>
#include <optional>

#include "external_command/core/path_borders.h"
#include "external_command/core/text.h"
#include "external_command/ros/checks.h"
#include "external_command/ros/conversions.h"

namespace external_command {

namespace {

void requireSameCount(std::size_t size, std::size_t way_points, const std::string& field) {
  if (size == way_points) return;
  throw InvalidRequest(text(field, " has ", size, " points, way_point ", way_points,
                            "; each border needs one point per way point, or give left_path_width and "
                            "right_path_width instead"));
}

/// In the frame of the command: sides are the same in any.
WaypointLine lineOf(const PathFollowCommand& command) {
  WaypointLine line;
  line.points = toMapPoints(command.way_point, {});
  line.headings = command.heading;
  return line;
}

PathBorders bordersOf(const PathFollowCommand& command) {
  return {toMapPoints(command.left_boundary, {}), toMapPoints(command.right_boundary, {})};
}

std::string onWrongSide(const std::string& border, std::size_t i, const Point2d& point, double by,
                        const std::string& side) {
  return text(border, "[", i, "] ", at(point), " lies ", metres(by), " to the ", side, " of the path");
}

void requireSides(const PathFollowCommand& command) {
  const WaypointLine line = lineOf(command);
  const PathBorders borders = bordersOf(command);
  const std::optional<BorderSides> swapped = swappedBorders(line, borders);
  if (!swapped) return;
  const std::size_t i = swapped->waypoint;
  throw InvalidRequest(text(onWrongSide("left_boundary", i, borders.left[i], -swapped->left, "right"), ", and ",
                            onWrongSide("right_boundary", i, borders.right[i], -swapped->right, "left"), ", at ",
                            "way_point[", i, "] ", at(line.points[i]), "; left and right are those of who drives ",
                            "along the path: exchange the two"));
}

/// Where the path lies beyond one of its borders.
void warnOfCrossedBorder(const PathFollowCommand& command, std::vector<std::string>* warnings) {
  const WaypointLine line = lineOf(command);
  const PathBorders borders = bordersOf(command);
  const std::optional<BorderSides> crossed = crossedBorder(line, borders);
  if (!crossed) return;
  const std::size_t i = crossed->waypoint;
  const bool is_left = crossed->left < crossed->right;
  warnings->push_back(text(is_left ? onWrongSide("left_boundary", i, borders.left[i], -crossed->left, "right")
                                   : onWrongSide("right_boundary", i, borders.right[i], -crossed->right, "left"),
                           " at way_point[", i, "] ", at(line.points[i]), ": the path leaves its borders"));
}

}  // namespace

void checkBorders(const PathFollowCommand& command) {
  requireNotNegative(command.left_path_width, "left_path_width");
  requireNotNegative(command.right_path_width, "right_path_width");
  const bool has_widths = command.left_path_width > 0.0 || command.right_path_width > 0.0;
  const bool has_boundaries = !command.left_boundary.empty() || !command.right_boundary.empty();
  if (has_widths && has_boundaries) {
    throw InvalidRequest(text("left_boundary has ", command.left_boundary.size(), " points, right_boundary ",
                              command.right_boundary.size(), ", and left_path_width is ", command.left_path_width,
                              ", right_path_width ", command.right_path_width,
                              "; give boundaries or widths, not both"));
  }
  if (has_widths && (command.left_path_width == 0.0 || command.right_path_width == 0.0)) {
    throw InvalidRequest(text("left_path_width is ", command.left_path_width, ", right_path_width ",
                              command.right_path_width, "; give both or neither"));
  }
  if (!has_boundaries) return;
  requireSameCount(command.left_boundary.size(), command.way_point.size(), "left_boundary");
  requireSameCount(command.right_boundary.size(), command.way_point.size(), "right_boundary");
  checkPoints(command.left_boundary, 2, "left_boundary");
  checkPoints(command.right_boundary, 2, "right_boundary");
  requireSides(command);
}

void warnOfBorders(const PathFollowCommand& command, double vehicle_width, std::vector<std::string>* warnings) {
  if (!command.left_boundary.empty()) warnOfCrossedBorder(command, warnings);
  const auto warn = [&](const std::string& what, double width) {
    warnings->push_back(text(what, " leave ", metres(width), " between them; the vehicle is ", metres(vehicle_width),
                             " wide (~vehicle/width)"));
  };
  const double width = command.left_path_width + command.right_path_width;
  if (width > 0.0 && width < vehicle_width) warn("left_path_width and right_path_width", width);
  for (std::size_t i = 0; i < command.left_boundary.size(); ++i) {
    const auto &left = command.left_boundary[i], &right = command.right_boundary[i];
    const double gap = std::hypot(left.x - right.x, left.y - right.y);
    if (gap >= vehicle_width) continue;
    return warn(text("left_boundary[", i, "] and right_boundary[", i, "]"), gap);
  }
}

}  // namespace external_command
