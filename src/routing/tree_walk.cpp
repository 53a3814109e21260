// SPDX-License-Identifier: Apache-2.0
#include "tree_walk.h"

#include "external_command/core/in_parallel.h"

namespace external_command {

TreeWalk::TreeWalk(const std::vector<std::size_t>& parents)
    : first_child_(parents.size() + 2, 0), left_(parents.size()) {
  for (const std::size_t parent : parents) {
    if (parent != kNoParent) ++first_child_[parent + 2];
  }
  for (std::size_t i = 2; i < first_child_.size(); ++i) first_child_[i] += first_child_[i - 1];
  children_.resize(first_child_.back());
  for (std::size_t node = 0; node < parents.size(); ++node) {
    if (parents[node] == kNoParent) {
      shared_.push_back(node);
    } else {
      children_[first_child_[parents[node] + 1]++] = node;
    }
  }
}

void TreeWalk::run(std::size_t threads, const std::function<Visit()>& make_visit) {
  inParallel(threads, [&](std::size_t) {
    try {
      work(make_visit());
    } catch (...) {
      end();
      throw;
    }
  });
}

void TreeWalk::work(const Visit& visit) {
  std::vector<std::size_t> own;
  for (std::size_t visited = 0; waitForOne(visited, &own);) {
    for (visited = 0; !own.empty(); ++visited) {
      const std::size_t node = own.back();
      own.pop_back();
      visit(node);
      own.insert(own.end(), children_.begin() + first_child_[node], children_.begin() + first_child_[node + 1]);
      if (own.size() > 1 && waiting_ > 0) share(&own);
    }
  }
}

/// @param visited  nodes since the last call.
/// @return false where all are.
bool TreeWalk::waitForOne(std::size_t visited, std::vector<std::size_t>* own) {
  std::unique_lock<std::mutex> lock(mutex_);
  left_ -= visited;
  if (left_ == 0) is_over_ = true;
  if (is_over_) changed_.notify_all();
  ++waiting_;
  changed_.wait(lock, [this] { return is_over_ || !shared_.empty(); });
  --waiting_;
  if (is_over_) return false;
  own->push_back(shared_.back());
  shared_.pop_back();
  return true;
}

void TreeWalk::share(std::vector<std::size_t>* own) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    shared_.push_back(own->front());
  }
  own->erase(own->begin());
  changed_.notify_one();
}

void TreeWalk::end() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_over_ = true;
  }
  changed_.notify_all();
}

}  // namespace external_command
