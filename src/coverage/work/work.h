// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "coverage/path/curve.h"

namespace external_command {

/// Something to be worked on in one go, and the ways in which that can be done: a swath from either end, a closed lap
/// from any of many places. All of them sweep about the same area.
class Work {
 public:
  /// Neither given way need be the other's reverse, but both should sweep the same.
  explicit Work(std::vector<Curve> ways);

  /// A closed lap, to be begun every `spacing` [m].
  static Work closed(const Curve& loop, double spacing);

  /// A way of its own, or one more closed lap in the same place.
  void add(const Curve& way);
  void addClosed(const Curve& loop, double spacing);

  std::size_t ways() const { return starts_.size(); }
  const Pose2d& startOf(std::size_t way) const { return starts_[way]; }
  const Pose2d& endOf(std::size_t way) const { return ends_[way]; }
  Curve curveOf(std::size_t way) const;
  double length() const { return curves_.front().length(); }

  /// Whether it has the same ways, in the same order.
  bool operator==(const Work& other) const;

  /// Whether way 1 is way 0 driven from the other end.
  bool isReversible() const { return reversible_; }

  /// Whether it can be begun at many places.
  bool isClosed() const { return entries_.size() > 2; }

  int lap = -1;          ///< of a lap: 0 is the outermost; -1 of a swath
  bool is_ring = false;  ///< a lap that is not along the border: around a hole, or in a part of its own

 private:
  static constexpr int kMostEntries = 2000;  ///< of one closed lap

  Work() = default;

  struct Entry {
    std::size_t curve = 0;
    double offset = 0.0;  ///< where on the closed curve it begins [m]
  };

  std::vector<Curve> curves_;
  std::vector<Entry> entries_;  ///< of each way
  std::vector<Pose2d> starts_;
  std::vector<Pose2d> ends_;
  bool reversible_ = false;
};

}  // namespace external_command
