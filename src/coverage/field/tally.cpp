// SPDX-License-Identifier: Apache-2.0
#include "tally.h"

#include <utility>

namespace external_command {

namespace {

constexpr std::uint8_t kMany = 255;  ///< counted no further, and never back

}  // namespace

Tally::Tally(CoverageGrid grid, double width) : grid_(std::move(grid)), width_(width), counts_(grid_.size(), 0) {}

/// Each cell of the goal once, however often the way crosses it.
template <class Visit>
void Tally::visit(const Curve& way, const Visit& visit) {
  cells_.clear();
  std::uint8_t* const cells = grid_.data();
  for (const auto& strip : stripsOf(way, width_)) {
    CoverageGrid::visitRuns(grid_, strip, [&](std::uint8_t* first, std::uint8_t* last) {
      for (; first != last; ++first) {
        if ((*first & (kGoal | kMarked)) != kGoal) continue;
        *first |= kMarked;
        cells_.push_back(static_cast<std::size_t>(first - cells));
      }
    });
  }
  for (const std::size_t cell : cells_) {
    cells[cell] &= static_cast<std::uint8_t>(~kMarked);
    visit(cell);
  }
}

void Tally::add(const Curve& way) {
  visit(way, [this](std::size_t cell) {
    if (counts_[cell] == 0) {
      ++covered_;
      grid_.data()[cell] |= kSwept;
    }
    if (counts_[cell] < kMany) ++counts_[cell];
  });
}

void Tally::remove(const Curve& way) {
  visit(way, [this](std::size_t cell) {
    if (counts_[cell] == 1) {
      --covered_;
      grid_.data()[cell] &= static_cast<std::uint8_t>(~kSwept);
    }
    if (counts_[cell] < kMany) --counts_[cell];
  });
}

double Tally::areaWith(const Curve& way, int count) {
  std::size_t cells = 0;
  visit(way, [&](std::size_t cell) { cells += counts_[cell] == count; });
  return static_cast<double>(cells) * grid_.cellArea();
}

double Tally::gain(const Curve& way) { return areaWith(way, 0); }

double Tally::only(const Curve& way) { return areaWith(way, 1); }

UnsweptPart Tally::cellsOnly(const Curve& way) {
  UnsweptPart part;
  const auto columns = static_cast<std::size_t>(grid_.columns());
  visit(way, [&](std::size_t cell) {
    if (counts_[cell] == 1) part.emplace_back(static_cast<int>(cell % columns), static_cast<int>(cell / columns));
  });
  return part;
}

}  // namespace external_command
