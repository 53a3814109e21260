// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace external_command {

/// Keeps what was asked for lately, up to a bound of the sum of its costs: what was asked for longest ago goes first.
/// Thread-safe; the mutex is held for a look-up, never while anything is computed.
template <class Key, class Value, class Hash>
class RecentMemory {
 public:
  explicit RecentMemory(std::size_t most) : most_(most) {}

  /// nullptr where it is not kept.
  std::shared_ptr<const Value> find(const Key& key) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = places_.find(key);
    if (known == places_.end()) return nullptr;
    entries_.splice(entries_.begin(), entries_, known->second);
    return known->second->value;
  }

  void keep(const Key& key, std::shared_ptr<const Value> value, std::size_t cost) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (cost > most_ || places_.count(key) != 0) return;  // another thread may have been faster
    entries_.push_front({key, std::move(value), cost});
    places_.emplace(key, entries_.begin());
    sum_ += cost;
    while (sum_ > most_) {
      sum_ -= entries_.back().cost;
      places_.erase(entries_.back().key);
      entries_.pop_back();
    }
  }

  /// Of the costs of what is kept.
  std::size_t sum() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return sum_;
  }

 private:
  struct Entry {
    Key key;
    std::shared_ptr<const Value> value;
    std::size_t cost;
  };
  using Entries = std::list<Entry>;

  const std::size_t most_;
  mutable std::mutex mutex_;
  Entries entries_;  ///< the latest first
  std::unordered_map<Key, typename Entries::iterator, Hash> places_;
  std::size_t sum_ = 0;
};

}  // namespace external_command
