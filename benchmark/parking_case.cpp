// SPDX-License-Identifier: Apache-2.0
#include "parking_case.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "external_command/core/error.h"
#include "external_command/core/obstacle_polygon.h"
#include "files.h"
#include "json_fields.h"

namespace external_command {
namespace benchmark {

namespace {

namespace fs = std::filesystem;

constexpr const char* kBestKnown = "best_known.json";

/// Andrew's monotone chain.
std::vector<Point2d> convexHull(std::vector<Point2d> points) {
  std::sort(points.begin(), points.end(),
            [](const Point2d& a, const Point2d& b) { return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y()); });
  std::vector<Point2d> hull;
  const auto addAll = [&](auto begin, auto end) {
    const std::size_t base = hull.size();
    for (auto point = begin; point != end; ++point) {
      while (hull.size() >= base + 2 && cross(hull.back() - hull[hull.size() - 2], *point - hull.back()) <= 0.0) {
        hull.pop_back();
      }
      hull.push_back(*point);
    }
    hull.pop_back();
  };
  addAll(points.begin(), points.end());
  addAll(points.rbegin(), points.rend());
  return hull;
}

Polygon obstacleOf(const std::vector<Point2d>& points, const std::string& name) {
  try {
    return obstaclePolygon(points, name);
  } catch (const InvalidRequest&) {
    return Polygon(convexHull(points), name);
  }
}

Region regionOf(const JsonTree& tree, const Point2d& origin) {
  Region::Parts parts;
  const std::vector<double> bounds = numbersOf(tree.get_child("bounds"), 4, "bounds");
  parts.axle_bounds = BoundingBox{Point2d(bounds[0], bounds[1]) - origin, Point2d(bounds[2], bounds[3]) - origin};
  for (const auto& ring : tree.get_child("obstacles")) {
    std::vector<Point2d> points;
    const std::string name = "obstacles[" + std::to_string(parts.non_drivable.size()) + "]";
    for (const auto& corner : ring.second) {
      const std::vector<double> xy = numbersOf(corner.second, 2, "a corner of " + name);
      points.emplace_back(Point2d(xy[0], xy[1]) - origin);
    }
    if (points.empty()) throw std::runtime_error(name + " has no corner; give at least one");
    parts.non_drivable.push_back(obstacleOf(points, name));
  }
  return Region(std::move(parts));
}

}  // namespace

ParkingCase readParkingCase(const std::string& file) {
  try {
    JsonTree tree;
    boost::property_tree::read_json(file, tree);
    const std::vector<double> start = numbersOf(tree.get_child("start"), 3, "start");
    const std::vector<double> goal = numbersOf(tree.get_child("goal"), 3, "goal");
    ParkingCase result;
    result.name = tree.get<std::string>("name", stemOf(file));
    result.vehicle = vehicleOf(tree.get_child("vehicle"), std::nullopt);
    result.origin = {std::round(goal[0]), std::round(goal[1])};
    result.start = {start[0] - result.origin.x(), start[1] - result.origin.y(), start[2]};
    result.goal = {goal[0] - result.origin.x(), goal[1] - result.origin.y(), goal[2]};
    result.region = regionOf(tree, result.origin);
    return result;
  } catch (const std::exception& error) {
    throw std::runtime_error(file + " is no parking case: " + error.what());
  }
}

std::vector<std::string> parkingCaseFiles(const std::vector<std::string>& files_and_folders) {
  std::vector<std::string> files = filesOf(files_and_folders, ".json");
  const auto is_no_case = [](const std::string& file) { return fs::path(file).filename() == kBestKnown; };
  files.erase(std::remove_if(files.begin(), files.end(), is_no_case), files.end());
  return files;
}

std::map<std::string, double> bestKnownCosts(const std::string& file) {
  std::map<std::string, double> costs;
  const fs::path path = fs::path(file).parent_path() / kBestKnown;
  if (!fs::exists(path)) return costs;
  JsonTree tree;
  boost::property_tree::read_json(path.string(), tree);
  for (const auto& entry : tree) costs[entry.first] = entry.second.get<double>("cost");
  return costs;
}

}  // namespace benchmark
}  // namespace external_command
