// SPDX-License-Identifier: Apache-2.0
#include "supernodes.h"

#include <algorithm>
#include <iterator>

namespace external_command {

std::size_t Supernode::columnOf(std::uint32_t node) const {
  if (node < first + count) return node - first;
  return count + static_cast<std::size_t>(std::lower_bound(above.begin(), above.end(), node) - above.begin());
}

Supernodes::Supernodes(std::vector<std::vector<std::uint32_t>> uppers) {
  for (std::vector<std::uint32_t>& own : uppers) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  std::vector<std::uint32_t> merged;
  for (std::uint32_t node = 0; node < uppers.size(); ++node) {
    const std::vector<std::uint32_t> own = std::move(uppers[node]);
    add(node, own);
    if (own.empty()) continue;
    std::vector<std::uint32_t>& parents = uppers[own.front()];
    merged.clear();
    std::set_union(own.begin() + 1, own.end(), parents.begin(), parents.end(), std::back_inserter(merged));
    parents.assign(merged.begin(), merged.end());
  }
  for (Supernode& supernode : all_) {
    supernode.rows = cells_;
    cells_ += supernode.count * supernode.width();
  }
}

void Supernodes::add(std::uint32_t node, const std::vector<std::uint32_t>& above) {
  const bool goes_on = !all_.empty() && !all_.back().above.empty() && all_.back().above.front() == node &&
                       all_.back().above.size() == above.size() + 1;
  if (!goes_on) {
    all_.emplace_back();
    all_.back().first = node;
  }
  ++all_.back().count;
  all_.back().above = above;
  of_.push_back(static_cast<std::uint32_t>(all_.size()) - 1);
}

std::uint32_t Supernodes::parent(std::uint32_t node, std::uint32_t none) const {
  const Supernode& supernode = of(node);
  if (node + 1 < supernode.first + supernode.count) return node + 1;
  return supernode.above.empty() ? none : supernode.above.front();
}

}  // namespace external_command
