// SPDX-License-Identifier: Apache-2.0
#include "../../src/routing/tree_walk.h"

#include <gtest/gtest.h>

#include <atomic>
#include <random>
#include <stdexcept>
#include <vector>

namespace external_command {
namespace {

constexpr std::size_t kNone = TreeWalk::kNoParent;

/// Each node hangs on one before it, or on none.
std::vector<std::size_t> randomForest(std::size_t size, double roots) {
  std::mt19937 random(1);
  std::vector<std::size_t> parents;
  for (std::size_t node = 0; node < size; ++node) {
    const bool is_root = node == 0 || std::bernoulli_distribution(roots)(random);
    parents.push_back(is_root ? kNone : std::uniform_int_distribution<std::size_t>(0, node - 1)(random));
  }
  return parents;
}

/// Expects each node to be visited once, and its parent before it.
void expectWalked(const std::vector<std::size_t>& parents, std::size_t threads) {
  std::vector<std::atomic<int>> visits(parents.size());
  TreeWalk(parents).run(threads, [&] {
    return [&](std::size_t node) {
      if (parents[node] != kNone) {
        EXPECT_EQ(visits[parents[node]], 1) << "of the parent of node " << node;
      }
      ++visits[node];
    };
  });
  for (std::size_t node = 0; node < visits.size(); ++node) EXPECT_EQ(visits[node], 1) << "node " << node;
}

TEST(TreeWalk, VisitsEachNodeOnceAndItsParentBeforeIt) {
  for (const std::size_t threads : {1U, 2U, 7U}) {
    expectWalked(randomForest(20000, 0.0), threads);
    expectWalked(randomForest(20000, 0.3), threads);
  }
}

TEST(TreeWalk, VisitsChainsStarsAndLonelyNodes) {
  std::vector<std::size_t> chain = {kNone}, star(1000, 0), lonely(1000, kNone);
  for (std::size_t node = 1; node < 1000; ++node) chain.push_back(node - 1);
  star.front() = kNone;
  for (const auto& parents : {chain, star, lonely, std::vector<std::size_t>{kNone}}) expectWalked(parents, 3);
}

TEST(TreeWalk, EndsWhereThereIsNothingToVisit) { expectWalked({}, 3); }

TEST(TreeWalk, MakesVisitsOfItsOwnForEachThread) {
  std::atomic<int> made{0};
  TreeWalk({kNone, 0, 0}).run(4, [&] {
    ++made;
    return [](std::size_t) {};
  });
  EXPECT_EQ(made, 4);
}

TEST(TreeWalk, ThrowsWhatAVisitThrewAndEnds) {
  const auto run = [](std::size_t threads) {
    TreeWalk(randomForest(20000, 0.1)).run(threads, [] {
      return [](std::size_t node) {
        if (node == 7) throw std::runtime_error("no more");
      };
    });
  };
  EXPECT_THROW(run(1), std::runtime_error);
  EXPECT_THROW(run(4), std::runtime_error);
}

}  // namespace
}  // namespace external_command
