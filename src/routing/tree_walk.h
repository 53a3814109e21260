// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <vector>

namespace external_command {

/// Visits all nodes of a forest once, each after its parent, on several threads. Each goes on with the children of what
/// it has visited; who has none left gets from another what that one would have visited last, a large part of the tree.
class TreeWalk {
 public:
  /// Visits one node.
  using Visit = std::function<void(std::size_t node)>;

  static constexpr std::size_t kNoParent = static_cast<std::size_t>(-1);

  /// @param parents  of each node, or kNoParent; without rings.
  explicit TreeWalk(const std::vector<std::size_t>& parents);

  /// Once.
  /// @param make_visit  called in each of the `threads`, whose visits it makes.
  /// What one of these throws is thrown again when all threads have ended.
  void run(std::size_t threads, const std::function<Visit()>& make_visit);

 private:
  void work(const Visit& visit);
  bool waitForOne(std::size_t visited, std::vector<std::size_t>* own);
  void share(std::vector<std::size_t>* own);
  void end();

  std::vector<std::size_t> first_child_, children_;  // by parent
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::size_t> shared_;       // ready to be visited, by any thread
  std::size_t left_;                      // not visited yet, or visited by threads that have not told yet
  std::atomic<std::size_t> waiting_ = 0;  // threads
  bool is_over_ = false;
};

}  // namespace external_command
