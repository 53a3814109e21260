// SPDX-License-Identifier: Apache-2.0
#include "made_cases.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "../test/support/vehicles.h"
#include "external_command/core/text.h"
#include "external_command/motion/collision_checker.h"

namespace external_command {
namespace benchmark {

namespace {

constexpr double kWall = 0.2;        ///< how thick walls are [m]
constexpr double kBay = 2.6;         ///< from one bay to the next [m]
constexpr double kBayDepth = 5.0;    // [m]
constexpr double kAisle = 6.5;       // [m]
constexpr double kClearance = 0.25;  ///< of starts and goals, where posts stand at random [m]

using Points = std::vector<Point2d>;

/// All that is random is drawn here, so that each case depends on those before it, and on the seed.
class CaseMaker {
 public:
  explicit CaseMaker(unsigned seed) : engine_(seed) {}

  std::vector<ParkingCase> make() {
    for (const int gates : {4, 7, 8, 10, 15, 20, 30}) addSlalom(gates, 7.0, 4.0);
    for (const int gates : {8, 12, 20}) addSlalom(gates, 6.5, 4.5);
    for (const int posts : {0, 100}) addLot(100.0, 60.0, posts);
    for (const int posts : {0, 500, 1500}) addLot(200.0, 150.0, posts);
    for (const int posts : {0, 3000, 7000}) addLot(300.0, 250.0, posts);
    for (const double gap : {1.2, 0.8, 0.5}) addDock(gap);
    for (const double width : {5.0, 4.0, 3.7}) addAlley(width);
    for (const int size : {6, 10, 14}) addMaze(size, 7.0);
    for (const double length : {500.0, 1000.0, 3000.0}) addRoad(length);
    for (const double distance : {100.0, 560.0}) addPlain(distance);
    addDenseObstacles();
    for (const double slack : {0.3, 0.1, -0.02, -0.4}) addGap(slack);
    for (const double width : {6.0, 4.2, 5.3}) addTurn(width);
    for (const double width : {4.0, 3.4, 2.7}) addTee(width);
    return std::move(cases_);
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  int pick(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }

  void begin(const std::string& name, const VehicleParams& vehicle, const Pose2d& start, const Pose2d& goal) {
    parts_ = {};
    case_ = {};
    case_.name = name;
    case_.vehicle = vehicle;
    case_.start = start;
    case_.goal = goal;
  }

  void end(double x0, double y0, double x1, double y1) {
    parts_.axle_bounds = BoundingBox{Point2d(x0, y0), Point2d(x1, y1)};
    case_.region = Region(std::move(parts_));
    cases_.push_back(case_);
  }

  void polygon(const Points& points) { parts_.non_drivable.emplace_back(points, "obstacle"); }
  void box(double x0, double y0, double x1, double y1) { polygon({{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}); }

  void wallsAround(double x0, double y0, double x1, double y1) {
    box(x0, y0 - kWall, x1, y0);
    box(x0, y1, x1, y1 + kWall);
    box(x0 - kWall, y0, x0, y1);
    box(x1, y0, x1 + kWall, y1);
  }

  void post(const Point2d& centre, double radius, int corners) {
    Points points;
    for (int i = 0; i < corners; ++i) points.push_back(centre + radius * unitVector(2.0 * M_PI * i / corners));
    polygon(points);
  }

  /// Walls from above and below in turn, each with a gap at its end.
  void addSlalom(int gates, double spacing, double gap) {
    const double width = 12.0, length = spacing * (gates + 1) + 1.0;
    begin(text("slalom_", gates, "_", spacing, "_", gap), car(), {0.0, 6.0, 0.0}, {length, 6.0, 0.0});
    box(-5.0, -kWall, length + 7.0, 0.0);
    box(-5.0, width, length + 7.0, width + kWall);
    for (int i = 0; i < gates; ++i) {
      const double x = 1.0 + spacing * (i + 1);
      if (i % 2 == 0) {
        box(x, gap, x + kWall, width);
      } else {
        box(x, 0.0, x + kWall, width - gap);
      }
    }
    end(-4.0, 0.0, length + 6.0, width);
  }

  /// A double row of bays, its aisle above it; one bay in twenty is free.
  void addRow(double y, double width) {
    for (const double from : {y, y + kBayDepth}) {
      for (double x = 7.0; x + kBay < width - 7.0; x += kBay) {
        if (pick(0, 19) == 0) continue;
        const double side = 0.5 * (kBay - uniform(1.7, 1.95)), length = uniform(4.0, 4.7);
        const double y0 = from + uniform(0.1, kBayDepth - length - 0.05);
        box(x + side, y0, x + kBay - side, y0 + length);
      }
    }
  }

  /// A car park, from its corner backing into a bay in the far one. Posts stand in it at random, but not where their
  /// shadow would close an aisle.
  void addLot(double width, double height, int posts) {
    const int rows = static_cast<int>((height - 2.0 * kAisle) / (2.0 * kBayDepth + kAisle));
    const double last_row = kAisle + (rows - 1) * (2.0 * kBayDepth + kAisle);
    const double bay = 7.0 + kBay * (std::floor((width - 14.0) / kBay) - 3.0);
    const Pose2d goal{bay + 0.5 * kBay, last_row + 2.0 * kBayDepth - kBayDepth + 1.3, M_PI / 2.0};
    begin(text("lot_", width, "x", height, "_", posts), car(), {2.5, 3.0, 0.0}, goal);
    for (int row = 0; row < rows; ++row) addRow(kAisle + row * (2.0 * kBayDepth + kAisle), width);
    const auto isInGoal = [&](const Polygon& polygon) {
      return polygon.contains(goal.position()) ||
             (polygon.box().max + polygon.box().min - 2.0 * (goal.position() + Point2d(0.0, 1.4)))
                     .cwiseAbs()
                     .maxCoeff() < 2.0 * 1.9;
    };
    auto& cars = parts_.non_drivable;
    cars.erase(std::remove_if(cars.begin(), cars.end(), isInGoal), cars.end());
    wallsAround(0.0, 0.0, width, height);
    addPosts(width, height, posts);
    end(0.0, 0.0, width, height);
  }

  /// Each in the middle of a square of its own with 4 m between them at least, or beside the cars.
  void addPosts(double width, double height, int posts) {
    const double side = std::sqrt(width * height / std::max(posts, 1));
    for (double x = side / 2.0; x < width; x += side) {
      for (double y = side / 2.0; y < height; y += side) {
        if (posts == 0) return;
        const Point2d at(x + uniform(-0.3, 0.3) * side, y + uniform(-0.3, 0.3) * side);
        const double in_row = std::fmod(at.y(), 2.0 * kBayDepth + kAisle);
        const bool is_in_aisle =
            in_row < kAisle + 0.3 || at.x() < 7.0 || at.x() > width - 7.0 || at.y() > height - kAisle;
        const bool is_at_edge = is_in_aisle && (in_row > kAisle - 0.8 && in_row < kAisle);
        const bool is_near_end =
            (at - case_.start.position()).norm() < 6.0 || (at - case_.goal.position()).norm() < 9.0;
        if ((is_in_aisle && !is_at_edge) || is_near_end) continue;
        post(at, uniform(0.05, 0.12), 8);
      }
    }
  }

  /// A lorry backs between two others against a ramp; `gap` in sum beside it.
  void addDock(double gap) {
    const VehicleParams vehicle = lorry();
    const double pitch = vehicle.width + 0.5 * gap, yard = 16.0;
    begin(text("dock_", gap), vehicle, {-25.0, yard - 3.0, 0.0}, {0.0, 2.2 + 0.4, M_PI / 2.0});
    for (int i = -6; i <= 6; ++i) {
      if (i != 0) box(i * pitch - 1.25, 0.3, i * pitch + 1.25, 0.3 + uniform(7.0, 8.6));
    }
    wallsAround(-35.0, 0.0, 35.0, 8.6 + yard);
    end(-35.0, 0.0, 35.0, 8.6 + yard);
  }

  /// A street with two right angles between walls, from one dead end into the other, nose first.
  void addAlley(double width) {
    begin(text("alley_", width), car(), {2.0, width / 2.0, 0.0}, {5.0, 60.0 + width / 2.0, M_PI});
    const double right = 40.0 + width, top = 60.0 + width;
    wallsAround(0.0, 0.0, right, top);
    box(-kWall, width, 40.0, 60.0);
    end(0.0, 0.0, right, top);
  }

  /// Made by a walk that turns back where it cannot go on: one way between any two cells.
  void addMaze(int size, double cell) {
    begin(text("maze_", size), car(), {0.5 * cell - 1.4, 0.5 * cell, 0.0},
          {(size - 0.5) * cell - 1.4, (size - 0.5) * cell, 0.0});
    std::vector<bool> is_seen(static_cast<std::size_t>(size * size)), is_open(4 * is_seen.size());
    const int dx[] = {1, 0, -1, 0}, dy[] = {0, 1, 0, -1};
    std::vector<int> walk{0};
    is_seen[0] = true;
    while (!walk.empty()) {
      const int here = walk.back(), x = here % size, y = here / size;
      std::vector<int> ways;
      for (int way = 0; way < 4; ++way) {
        const int nx = x + dx[way], ny = y + dy[way];
        if (nx < 0 || ny < 0 || nx >= size || ny >= size) continue;
        if (!is_seen[static_cast<std::size_t>(ny * size + nx)]) ways.push_back(way);
      }
      if (ways.empty()) {
        walk.pop_back();
        continue;
      }
      const int way = ways[static_cast<std::size_t>(pick(0, static_cast<int>(ways.size()) - 1))];
      const int next = (y + dy[way]) * size + x + dx[way];
      is_open[static_cast<std::size_t>(4 * here + way)] = is_open[static_cast<std::size_t>(4 * next + (way + 2) % 4)] =
          true;
      is_seen[static_cast<std::size_t>(next)] = true;
      walk.push_back(next);
    }
    const double h = kWall / 2.0;
    for (int i = 0; i < size * size; ++i) {
      const double x = (i % size) * cell, y = (i / size) * cell;
      const auto at = static_cast<std::size_t>(4 * i);
      if (!is_open[at]) box(x + cell - h, y - h, x + cell + h, y + cell + h);
      if (!is_open[at + 1]) box(x - h, y + cell - h, x + cell + h, y + cell + h);
    }
    box(-h, -h, h, size * cell + h);
    box(-h, -h, size * cell + h, h);
    end(0.0, 0.0, size * cell, size * cell);
  }

  /// A winding road of 8 m with cars parked on both sides in turn.
  void addRoad(double length) {
    const auto middle = [&](double x) { return Point2d(x, 30.0 * std::sin(x / 60.0)); };
    const auto across = [&](double x) {
      const double slope = 0.5 * std::cos(x / 60.0);
      return Point2d(Point2d(-slope, 1.0) / std::hypot(1.0, slope));
    };
    const auto heading = [&](double x) { return std::atan(0.5 * std::cos(x / 60.0)); };
    const double last = length - 10.0;
    begin(text("road_", length), car(), {5.0, middle(5.0).y(), heading(5.0)}, {last, middle(last).y(), heading(last)});
    for (const double side : {-1.0, 1.0}) {
      for (double x = -10.0; x < length; x += 10.0) {
        const Point2d a = middle(x) + side * 4.0 * across(x), b = middle(x + 10.0) + side * 4.0 * across(x + 10.0);
        polygon({a, b, b + side * kWall * across(x + 10.0), a + side * kWall * across(x)});
      }
    }
    for (double x = 40.0; x < length - 40.0; x += uniform(25.0, 45.0)) {
      const double side = pick(0, 1) == 0 ? -1.0 : 1.0;
      const Pose2d parked{middle(x).x(), middle(x).y(), heading(x)};
      Points points;
      for (const Point2d& corner : {Point2d(-2.2, 1.9), Point2d(2.2, 1.9), Point2d(2.2, 3.7), Point2d(-2.2, 3.7)}) {
        points.push_back(compose(parked, {corner.x(), side * corner.y(), 0.0}).position());
      }
      polygon(points);
    }
    end(0.0, -40.0, length, 40.0);
  }

  void addPlain(double distance) {
    begin(text("plain_", distance), car(), {0.0, 0.0, 0.0}, {-distance, 0.3 * distance, 0.4});
    post({-0.5 * distance, 0.1 * distance}, 2.0, 12);
    end(-1.2 * distance, -0.5 * distance, 0.5 * distance, distance);
  }

  /// Rocks of 1,500 vertices each.
  void addDenseObstacles() {
    begin("rocks", car(), {-45.0, 0.0, 0.0}, {45.0, 0.0, 0.0});
    for (double x = -36.0; x < 40.0; x += 12.0) {
      for (double y = -18.0; y < 20.0; y += 12.0) {
        const Point2d centre(x + uniform(-1.5, 1.5), y + uniform(-1.5, 1.5));
        Points points;
        for (int i = 0; i < 1500; ++i) {
          points.push_back(centre + uniform(2.9, 3.0) * unitVector(2.0 * M_PI * i / 1500.0));
        }
        polygon(points);
      }
    }
    end(-50.0, -24.0, 50.0, 24.0);
  }

  /// A wall with one gap, `slack` wider than the vehicle.
  void addGap(double slack) {
    begin(text("gap_", slack), car(), {-12.0, 0.0, 0.0}, {10.0, 0.0, 0.0});
    const double half = 0.5 * (case_.vehicle.width + slack);
    box(0.0, -30.0, 0.3, -half);
    box(0.0, half, 0.3, 30.0);
    end(-20.0, -20.0, 20.0, 20.0);
  }

  /// Round and back in a street, in the narrower of which there is no room for that.
  void addTurn(double width) {
    begin(text("turn_", width), car(), {-30.0, 0.0, 0.0}, {0.0, 0.0, M_PI});
    for (const double side : {-1.0, 1.0}) {
      const double a = 0.5 * side * width, b = a + side * kWall;
      box(-40.0, std::min(a, b), 40.0, std::max(a, b));
    }
    for (const double x : {-40.0, 40.0 - kWall}) box(x, -0.5 * width, x + kWall, 0.5 * width);
    end(-40.0, -0.5 * width, 40.0, 0.5 * width);
  }

  /// Round and back in a street by way of a blind alley, both as wide.
  void addTee(double width) {
    const double depth = width + 8.0;
    begin(text("tee_", width), car(), {-14.0, 0.5 * width, 0.0}, {-14.0, 0.5 * width, M_PI});
    wallsAround(-30.0, 0.0, 30.0, depth);
    box(-30.0, width, -0.5 * width, depth);
    box(0.5 * width, width, 30.0, depth);
    end(-30.0, 0.0, 30.0, depth);
  }

  std::mt19937 engine_;
  Region::Parts parts_;
  ParkingCase case_;
  std::vector<ParkingCase> cases_;
};

}  // namespace

std::vector<ParkingCase> makeParkingCases(unsigned seed) { return CaseMaker(seed).make(); }

}  // namespace benchmark
}  // namespace external_command
