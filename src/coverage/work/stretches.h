// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

namespace external_command {

/// A run of columns.
struct Stretch {
  int begin = 0;
  int end = 0;  ///< one past the last
};

/// Where along one line it pays to work: a worth for what is swept in each column, less a price of each column and of
/// each beginning. Two running optima, with the tool on and off, and a walk back.
class StretchSearch {
 public:
  /// @param beginning  price of beginning a stretch.
  /// @param column     price of driving through a column.
  StretchSearch(double beginning, double column) : beginning_(beginning), column_(column) {}

  /// @param worth  of a column, not negative.
  /// @param toll   of being in a column, besides its price, with the tool on since the column before or, if the second
  ///               argument says so, from this one on; infinite where the vehicle cannot be. Asked only where it
  ///               matters, column after column.
  /// @return the best sum.
  template <class Worth, class Toll>
  double best(int columns, const Worth& worth, const Toll& toll) {
    double on = kNever, off = 0.0;
    changes_.clear();
    for (int i = 0; i < columns; ++i) {
      const double gain = worth(i);
      const double begun = gain > 0.0 && off - beginning_ > on ? off - beginning_ + gain - column_ : kNever;
      const double kept = isOn(on) ? std::max(kNever, on + gain - column_ - toll(i, false)) : kNever;
      if (on > off) {
        off = on;
        changes_.push_back({i, Change::kEnd});
      }
      on = kept;
      if (begun <= kept) continue;
      const double paid = begun - toll(i, true);
      if (paid <= kept) continue;
      on = paid;
      changes_.push_back({i, Change::kBegin});
    }
    if (on > off) {
      off = on;
      changes_.push_back({columns, Change::kEnd});
    }
    return off;
  }

  /// The stretches of the last search, in order.
  std::vector<Stretch> stretches() const {
    std::vector<Stretch> result;
    int end = -1;  // of the stretch being walked back through
    for (auto change = changes_.rbegin(); change != changes_.rend(); ++change) {
      if (change->kind == Change::kEnd && end < 0) end = change->column;
      if (change->kind == Change::kBegin && end > change->column) {
        result.insert(result.begin(), {change->column, end});
        end = -1;
      }
    }
    return result;
  }

 private:
  static constexpr double kNever = -1e12;

  static bool isOn(double sum) { return sum > kNever / 2.0; }

  struct Change {
    enum Kind { kBegin, kEnd };
    int column;
    Kind kind;  ///< of the best way to have the tool on from this column, or off
  };

  double beginning_;
  double column_;
  std::vector<Change> changes_;
};

}  // namespace external_command
