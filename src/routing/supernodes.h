// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

namespace external_command {

/// Nodes of a contraction hierarchy, one after the other, that are all linked with each other and above them with the
/// same nodes. Their arcs are kept as dense rows: arithmetic on these goes through memory in order.
struct Supernode {
  std::uint32_t first = 0, count = 0;  ///< its own nodes
  std::vector<std::uint32_t> above;    ///< rising
  std::size_t rows = 0;                ///< where the first row begins, among those of all

  std::size_t width() const { return count + above.size(); }
  std::size_t row(std::uint32_t node) const { return rows + (node - first) * width(); }
  std::uint32_t nodeAt(std::size_t column) const {
    return column < count ? first + static_cast<std::uint32_t>(column) : above[column - count];
  }
  /// The column of a node that has one.
  std::size_t columnOf(std::uint32_t node) const;
};

/// The supernodes of a graph whose nodes are taken out in order: where one goes, all those it links become linked.
class Supernodes {
 public:
  /// @param uppers  for each node those above it that it is linked with, in any order.
  explicit Supernodes(std::vector<std::vector<std::uint32_t>> uppers);

  const std::vector<Supernode>& all() const { return all_; }
  const Supernode& of(std::uint32_t node) const { return all_[of_[node]]; }
  std::size_t indexOf(std::uint32_t node) const { return of_[node]; }  ///< in `all`
  std::size_t size() const { return of_.size(); }                      ///< nodes
  std::size_t cells() const { return cells_; }                         ///< of all rows

  /// The lowest node above this one that it is linked with; `none` of a root.
  std::uint32_t parent(std::uint32_t node, std::uint32_t none) const;

 private:
  void add(std::uint32_t node, const std::vector<std::uint32_t>& above);

  std::vector<Supernode> all_;
  std::vector<std::uint32_t> of_;
  std::size_t cells_ = 0;
};

}  // namespace external_command
