// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <vector>

namespace external_command {

/// A run of columns.
struct Stretch {
  int begin = 0;
  int end = 0;  ///< one past the last

  int length() const { return end - begin; }
};

/// Worth of a column that must not be in any stretch.
constexpr double kNever = -1e12;

/// Where along one line it pays to work, for a worth of each column and a price of each beginning: two running optima,
/// with the tool on and off, and a walk back.
/// @param stretches  gets the stretches in order; may be null.
/// @return the best sum.
template <class Worth>
double bestStretches(int columns, double beginning, const Worth& worth, std::vector<Stretch>* stretches) {
  double on = kNever, off = 0.0;
  std::vector<char> begins(static_cast<std::size_t>(columns)), ends(static_cast<std::size_t>(columns));
  for (int i = 0; i < columns; ++i) {
    const double on_before = on, off_before = off;
    begins[static_cast<std::size_t>(i)] = off_before - beginning > on_before;
    ends[static_cast<std::size_t>(i)] = on_before > off_before;
    on = std::max(on_before, off_before - beginning) + worth(i);
    off = std::max(off_before, on_before);
  }
  bool working = on > off;
  int end = columns;
  for (int i = columns; stretches != nullptr && i-- > 0;) {
    if (working && begins[static_cast<std::size_t>(i)]) {
      stretches->push_back({i, end});
      working = false;
    } else if (!working && ends[static_cast<std::size_t>(i)]) {
      working = true;
      end = i;
    }
  }
  if (stretches != nullptr) std::reverse(stretches->begin(), stretches->end());
  return std::max(on, off);
}

}  // namespace external_command
