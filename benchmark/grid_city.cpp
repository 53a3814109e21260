// SPDX-License-Identifier: Apache-2.0
#include "grid_city.h"

#include <cmath>

#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr double kBlock = 150.0;  // [m]
constexpr double kWidth = 3.5;    // of a lane [m]
constexpr double kStop = 12.0;    // from the middle of a crossing to where the lanes end [m]
constexpr int kLanes = 2;         // each way
constexpr int kSteps = 6;         // points of a turn

class City {
 public:
  explicit City(int size) : size_(size) {}

  MapData build() {
    map_.version = "grid city";
    for (int i = 0; i < size_; ++i) {
      for (int k = 0; k < size_; ++k) {
        for (int direction = 0; direction < 4; ++direction) addStreet(i, k, direction);
      }
    }
    return std::move(map_);
  }

 private:
  static Point2d ahead(int direction) { return unitVector(direction * M_PI / 2).array().round().matrix(); }

  bool hasCrossing(const Point2d& at) const { return at.x() >= 0 && at.y() >= 0 && at.x() < size_ && at.y() < size_; }

  /// Lane 0 is the left one.
  static std::string streetId(const Point2d& from, int direction, int lane) {
    return text("s", from.x(), "_", from.y(), "_", direction, "_", lane);
  }

  static std::string wayId(const Point2d& at, int direction, int turn, int lane) {
    return text("w", at.x(), "_", at.y(), "_", direction, "_", turn, "_", lane);
  }

  static Point2d sideOf(int direction, int lane) {
    const Point2d along = ahead(direction);
    return (lane + 0.5) * kWidth * Point2d(along.y(), -along.x());
  }

  LaneData& addLane(const std::string& id, std::vector<Point2d> center) {
    LaneData lane;
    lane.id = id;
    for (std::size_t i = 1; i < center.size(); ++i) lane.length += (center[i] - center[i - 1]).norm();
    lane.center = std::move(center);
    lane.speed_limit = 13.9;
    map_.lanes.push_back(std::move(lane));
    return map_.lanes.back();
  }

  void addStreet(int i, int k, int direction) {
    const Point2d from(i, k), to = from + ahead(direction);
    if (!hasCrossing(to)) return;
    for (int lane = 0; lane < kLanes; ++lane) {
      const Point2d side = sideOf(direction, lane);
      LaneData& street = addLane(streetId(from, direction, lane), {kBlock * from + kStop * ahead(direction) + side,
                                                                   kBlock * to - kStop * ahead(direction) + side});
      street.left.types = street.right.types = {{0.0, BoundaryType::kDottedWhite}};
      if (lane > 0) street.left_forward = {streetId(from, direction, lane - 1)};
      if (lane + 1 < kLanes) street.right_forward = {streetId(from, direction, lane + 1)};
      for (const int turn : {-1, 0, 1}) {
        const bool from_here = turn == 0 || (turn > 0) == (lane == 0);
        const int out = (direction + turn + 4) % 4;
        if (!from_here || !hasCrossing(to + ahead(out))) continue;
        map_.lanes[&street - map_.lanes.data()].successors.push_back(wayId(to, direction, turn, lane));
      }
    }
    for (int lane = 0; lane < kLanes; ++lane) addWays(to, direction, lane);
  }

  void addWays(const Point2d& at, int direction, int lane) {
    for (const int turn : {-1, 0, 1}) {
      const int out = (direction + turn + 4) % 4;
      if ((turn != 0 && (turn > 0) != (lane == 0)) || !hasCrossing(at + ahead(out))) continue;
      const Point2d begin = kBlock * at - kStop * ahead(direction) + sideOf(direction, lane);
      const Point2d end = kBlock * at + kStop * ahead(out) + sideOf(out, lane);
      const Point2d corner = begin + ahead(direction) * (end - begin).dot(ahead(direction));
      std::vector<Point2d> center;
      for (int step = 0; step <= kSteps; ++step) {  // a quadratic Bezier curve
        const double t = static_cast<double>(step) / kSteps;
        center.push_back((1 - t) * (1 - t) * begin + 2 * t * (1 - t) * corner + t * t * end);
      }
      addLane(wayId(at, direction, turn, lane), std::move(center)).successors = {streetId(at, out, lane)};
    }
  }

  int size_;
  MapData map_;
};

}  // namespace

MapData gridCity(int crossings_per_side) { return City(crossings_per_side).build(); }

}  // namespace external_command
