// SPDX-License-Identifier: Apache-2.0
#include "cell_costs.h"

#include <queue>
#include <utility>

namespace external_command {

namespace {

/// The cells that wait, by cost: a bucket for each cost that a step at an ordinary price leads to, a heap for the few
/// dearer ones.
class Waiting {
 public:
  Waiting() : buckets_(kAcrossStep * 10 + 1) {}

  bool empty() const { return in_buckets_ == 0 && dear_.empty(); }

  void add(CellCost cost, long cell) {
    if (cost - now_ >= buckets_.size()) {
      dear_.emplace(cost, cell);
    } else {
      buckets_[cost % buckets_.size()].push_back(cell);
      ++in_buckets_;
    }
  }

  /// Takes one of the cheapest. There must be one.
  std::pair<CellCost, long> take() {
    while (bucket().empty()) {
      now_ = in_buckets_ > 0 ? now_ + 1 : dear_.top().first;
      for (; !dear_.empty() && dear_.top().first == now_; dear_.pop()) add(now_, dear_.top().second);
    }
    const long cell = bucket().back();
    bucket().pop_back();
    --in_buckets_;
    return {now_, cell};
  }

 private:
  using Entry = std::pair<CellCost, long>;

  std::vector<long>& bucket() { return buckets_[now_ % buckets_.size()]; }

  CellCost now_ = 0;
  std::size_t in_buckets_ = 0;
  std::vector<std::vector<long>> buckets_;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> dear_;
};

}  // namespace

std::vector<CellCost> costsTo(const CellGrid& grid, const std::vector<std::uint16_t>& prices, long target,
                              const std::function<bool(long cell)>& stop) {
  std::vector<CellCost> costs(prices.size(), kUnreachedCell);
  Waiting waiting;
  costs[static_cast<std::size_t>(target)] = 0;
  waiting.add(0, target);
  while (!waiting.empty()) {
    const auto [cost, cell] = waiting.take();
    if (costs[static_cast<std::size_t>(cell)] < cost) continue;
    if (stop(cell)) break;
    grid.forEachAround(cell, [&, cost = cost](long next, bool is_across) {
      const CellCost price = prices[static_cast<std::size_t>(next)];
      const CellCost through = cost + (is_across ? kAcrossStep : kStraightStep) * price;
      CellCost& known = costs[static_cast<std::size_t>(next)];
      if (price == 0 || through >= known) return;
      known = through;
      waiting.add(through, next);
    });
  }
  return costs;
}

}  // namespace external_command
