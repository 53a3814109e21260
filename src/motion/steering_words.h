// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include "external_command/core/pose.h"
#include "external_command/motion/reeds_shepp.h"

namespace external_command {

/// What a manoeuvre costs, in metres of driving forward.
struct CostModel {
  double gear_change_cost = 0.0;
  double forward_factor = 1.0;
  double reverse_factor = 1.0;
  double steering_price = 0.0;  ///< of turning the wheels while driving: metres for a change of curvature by 1 [1/m]

  /// Of a change of curvature between two arcs of the same gear.
  double ofSteering(double from_kappa, double to_kappa) const {
    return steering_price * std::abs(to_kappa - from_kappa);
  }

  /// Of going over from one arc to the next, which is not empty.
  double between(const ArcSegment& arc, const ArcSegment& next) const {
    return (arc.length < 0.0) != (next.length < 0.0) ? gear_change_cost : ofSteering(arc.kappa, next.kappa);
  }

  double ofArc(double length) const { return length >= 0.0 ? length * forward_factor : -length * reverse_factor; }

  /// For curves that are searched from their end to their begin.
  CostModel reversed() const { return {gear_change_cost, reverse_factor, forward_factor, steering_price}; }
};

/// The gears in which the vehicle arrives at a curve and goes on after it: +1, -1, or 0 where that is free; and the
/// curvatures with which it does so, which count where the gear stays the same [1/m].
struct Junctions {
  int before = 0;
  int after = 0;
  double kappa_before = 0.0;
  double kappa_after = 0.0;
};

/// A Reeds-Shepp or Dubins word with its lengths [m].
struct SteeringWord {
  std::array<ArcSegment, 5> arcs;
  int size = 0;
  int gear_changes = 0;  ///< within the word
  double length = 0.0;
  double cost = 0.0;  ///< with gear changes and steering at its ends, as far as the junctions are known
};

/// The words that join two poses, in no order.
class WordSet {
 public:
  static constexpr int kCapacity = 64;

  void clear() { size_ = 0; }
  void add(const SteeringWord& word) { words_[size_++] = word; }
  int size() const { return size_; }
  const SteeringWord& operator[](int i) const { return words_[i]; }

  /// Takes the cheapest word out and returns it; the set must not be empty.
  SteeringWord takeCheapest();

 private:
  std::array<SteeringWord, kCapacity> words_;
  int size_ = 0;
};

/// What words to make.
struct WordQuery {
  double radius = 1.0;
  CostModel cost;
  Junctions junctions;
  double max_cost = std::numeric_limits<double>::infinity();  ///< dearer words are left out
};

/// Puts every Reeds-Shepp word from `from` to `to` into `words`, which is cleared first.
void reedsSheppWords(const Pose2d& from, const Pose2d& to, const WordQuery& query, WordSet* words);

/// The same for the Dubins words, forward only.
void dubinsWords(const Pose2d& from, const Pose2d& to, const WordQuery& query, WordSet* words);

}  // namespace external_command
