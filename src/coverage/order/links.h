// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "coverage/field/field.h"
#include "coverage/field/routes.h"
#include "coverage/path/connector.h"
#include "coverage/work/work.h"

namespace external_command {

/// How to get from place to place in a field; remembered for all plans that are made for it.
struct Guide {
  explicit Guide(const Field& field) : routes(field), connector(field) {}

  Routes routes;
  Connector connector;
};

/// A piece of work, and which of its ways is taken.
struct Step {
  std::size_t work = 0;
  std::size_t way = 0;
};

/// What it takes to get from the end of one piece of work to the start of another: about, from the cheapest turn that
/// there seems to be room for and what the way round things in between adds; or as worked out. Remembers both.
class Links {
 public:
  static constexpr double kNoWay = 1e5;  ///< price of a way that was not found [m]

  /// `works` may grow at its end.
  Links(const Field& field, const std::vector<Work>& works, Guide* guide);

  const Field& field() const { return field_; }
  const Pose2d& startOf(const Step& step) const { return works_[step.work].startOf(step.way); }
  const Pose2d& endOf(const Step& step) const { return works_[step.work].endOf(step.way); }

  /// From the end of `from`, or from the vehicle's start without it; 0 if there is no start, or nothing to go to.
  /// The length, and the price of the changes of gear [m].
  double price(const Step* from, const Step* to) {
    const Cost cost = costOf(from, to);
    return static_cast<double>(cost.price) + (cost.is_guess ? doubt_ : 0.0);
  }

  double length(const Step* from, const Step* to) { return static_cast<double>(costOf(from, to).length); }  ///< [m]

  /// Works out the way that price() only guesses at. @return whether it differs.
  bool settle(const Step* from, const Step* to);

  /// Makes guesses dearer from now on: by what the ways that were worked out since the last call took more than
  /// guessed, in the mean. An order that is improved by guesses takes those that are too low.
  void doubtGuesses();

  /// The way that was worked out; nullopt if there is none.
  std::optional<Curve> way(const Step* from, const Step* to) const;

  /// A lower bound of it: the straight distance [m].
  double bound(const Step* from, const Step* to) const;

  /// A lower bound of what it takes to get from `before` to `first` and from `last` to `after` [m].
  double bound(const Step* before, const Step& first, const Step& last, const Step* after) const {
    return bound(before, &first) + bound(&last, after);
  }

  /// What it adds to a tour to do `first` ... `last` between two steps, the way between those two not counted [m].
  double detour(const Step* before, const Step& first, const Step& last, const Step* after) {
    return price(before, &first) + price(&last, after) - price(before, after);
  }

  /// The same in length, of one step [m].
  double longer(const Step* before, const Step& step, const Step* after) {
    return length(before, &step) + length(&step, after) - length(before, after);
  }

 private:
  struct Cost {
    float price;   ///< [m]
    float length;  ///< [m]
    bool is_guess;
  };

  Cost costOf(const Step* from, const Step* to);
  Cost guess(const Pose2d& from, const Pose2d& to);
  bool hasRoom(const Pose2d& from, const SteeringCurve& turn) const;
  static std::uint64_t idOf(const Step* from, const Step* to);

  const Field& field_;
  const std::vector<Work>& works_;
  Guide& guide_;
  Curve curveOf(const Step& step) const { return works_[step.work].curveOf(step.way); }
  Pose2d beginOf(const Step* from) const { return from == nullptr ? *field_.start() : endOf(*from); }

  std::unordered_map<std::uint64_t, Cost> known_;
  std::unordered_map<std::uint64_t, std::optional<Curve>> ways_;
  double doubt_ = 0.0;        ///< added to each guess [m]
  double excess_ = 0.0;       ///< of the ways worked out since doubtGuesses(), over their guesses [m]
  std::size_t excesses_ = 0;  ///< how many these are
};

/// The step at a place of a tour; null before the first and after the last.
inline const Step* stepAt(const std::vector<Step>& tour, long i) {
  return i < 0 || i >= static_cast<long>(tour.size()) ? nullptr : &tour[static_cast<std::size_t>(i)];
}

}  // namespace external_command
