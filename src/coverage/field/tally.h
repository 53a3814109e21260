// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "coverage/path/curve.h"
#include "grid.h"
#include "uncovered.h"

namespace external_command {

/// How many pieces of work sweep each cell.
class Tally {
 public:
  /// @param grid   of the field, nothing swept yet.
  /// @param width  of the tool [m].
  Tally(CoverageGrid grid, double width);

  void add(const Curve& way);
  void remove(const Curve& way);

  double gain(const Curve& way);            ///< area of the goal that only `way`, not added yet, would sweep [m^2]
  double only(const Curve& way);            ///< that only `way`, already added, sweeps [m^2]
  UnsweptPart cellsOnly(const Curve& way);  ///< the cells of that
  double covered() const { return static_cast<double>(covered_) * grid_.cellArea(); }  ///< of the goal [m^2]

  /// The grid with what is swept.
  const CoverageGrid& grid() const { return grid_; }

 private:
  template <class Visit>
  void visit(const Curve& way, const Visit& visit);
  double areaWith(const Curve& way, int count);

  CoverageGrid grid_;
  double width_;
  std::vector<std::uint8_t> counts_;
  std::size_t covered_ = 0;
  std::vector<std::size_t> cells_;  ///< of the way in hand
};

}  // namespace external_command
