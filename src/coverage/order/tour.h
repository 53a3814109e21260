// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "links.h"

namespace external_command {

/// An order of work, made shorter by 2-opt and Or-opt moves (G. Croes 1958, I. Or 1976) until none helps. What comes
/// before it stays where it is.
class Tour {
 public:
  Tour(Links* links, const std::vector<Work>& works, std::optional<Step> before)
      : links_(*links), works_(works), before_(before) {}

  /// Begins with the nearest neighbour, and on from there.
  void build(std::vector<std::size_t> todo);

  /// Begins with an order found before.
  void take(std::vector<Step> steps) { steps_ = std::move(steps); }

  /// @param until  share of the budget after which nothing more is tried.
  void improve(double until);

  const std::vector<Step>& steps() const { return steps_; }

 private:
  const Step* at(long i) const { return i < 0 && before_ ? &*before_ : stepAt(steps_, i); }
  Step nearest(const std::vector<std::size_t>& todo);
  bool canTurn(const Step& step) const { return works_[step.work].isReversible(); }
  bool turnParts(double until);
  bool moveParts(double until);
  void measure(long first, long last);  ///< the gaps before steps `first` ... `last`
  double gap(long i) const { return gaps_[static_cast<std::size_t>(i)]; }
  bool isLate(double until) const { return links_.field().timeUsed() > until; }
  bool movePart(long begin, long count);

  Links& links_;
  const std::vector<Work>& works_;
  std::optional<Step> before_;
  std::vector<Step> steps_;
  std::vector<double> gaps_;  ///< in improve(): the price of the way to each step, and behind the last one [m]
};

/// Where a piece of work fits into a tour best.
struct Insertion {
  double price = 0.0;  ///< what it adds, without the work itself [m]
  std::size_t place = 0;
  Step step;
};
Insertion cheapestInsertion(Links* links, const std::vector<Work>& works, std::size_t work,
                            const std::vector<Step>& steps);

}  // namespace external_command
