// SPDX-License-Identifier: Apache-2.0
#include "order.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace external_command {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr int kNeighbours = 8;
constexpr int kMaxPasses = 30;
constexpr int kMaxMoved = 3;  ///< pieces that are moved together

/// Ways of all works, numbered through, with the price of going from the end of one to the start of another.
class Links {
 public:
  Links(const Field& field, const std::vector<Work>& works, Routes* routes) : field_(field), routes_(*routes) {
    for (const Work& work : works) {
      offsets_.push_back(starts_.size());
      for (const Curve& way : work.ways) {
        starts_.push_back(way.start);
        ends_.push_back(way.end());
      }
    }
    starts_.push_back(Pose2d{});
    ends_.push_back(field.start().value_or(Pose2d{}));
  }

  const Pose2d& startOf(const Step& step) const { return starts_[idOf(step)]; }
  const Pose2d& endOf(const Step& step) const { return ends_[idOf(step)]; }

  /// From the end of `from` to the start of `to`; from the field's start if there is no `from`. Nothing to nowhere.
  double price(const Step* from, const Step* to) {
    if (to == nullptr || (from == nullptr && !field_.start())) return 0.0;
    const std::uint64_t a = from ? idOf(*from) : ends_.size() - 1, b = idOf(*to);
    const auto [entry, is_new] = known_.try_emplace(a * starts_.size() + b, 0.0F);
    if (is_new) entry->second = static_cast<float>(compute(ends_[a], starts_[b]));
    return static_cast<double>(entry->second);
  }

 private:
  std::size_t idOf(const Step& step) const { return offsets_[step.work] + step.way; }

  double compute(const Pose2d& from, const Pose2d& to) {
    const double straight = (to.position() - from.position()).norm();
    const double driven = reedsSheppLength(from, to, field_.radius());
    return driven + routes_.distance(from.position(), to.position()) - straight;
  }

  const Field& field_;
  Routes& routes_;
  std::vector<std::size_t> offsets_;
  std::vector<Pose2d> starts_;
  std::vector<Pose2d> ends_;
  std::unordered_map<std::uint64_t, float> known_;
};

/// An order of pieces that can each be done from either end, made shorter by 2-opt and Or-opt moves (G. Croes 1958,
/// I. Or 1976) until none helps. `before` comes first and stays where it is.
class SwathTour {
 public:
  SwathTour(Links* links, const std::vector<Work>& works, const Step* before)
      : links_(*links), works_(works), before_(before) {}

  std::vector<Step> plan(std::vector<std::size_t> todo) {
    startWithNearest(std::move(todo));
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const bool turned = turnParts(), moved = moveParts();
      if (!turned && !moved) break;
    }
    return tour_;
  }

 private:
  void startWithNearest(std::vector<std::size_t> todo) {
    const Step* at = before_;
    while (!todo.empty()) {
      double best = kInfinity;
      std::size_t pick = 0;
      Step next;
      for (std::size_t i = 0; i < todo.size(); ++i) {
        for (std::size_t way = 0; way < works_[todo[i]].ways.size(); ++way) {
          const Step step{todo[i], way};
          const double bound = at ? (links_.endOf(*at).position() - links_.startOf(step).position()).norm() : 0.0;
          if (bound >= best) continue;
          const double price = links_.price(at, &step);
          if (price < best) best = price, pick = i, next = step;
        }
      }
      tour_.push_back(next);
      at_ = next;
      at = &at_;
      todo.erase(todo.begin() + static_cast<long>(pick));
    }
  }

  const Step* at(long i) const {
    if (i < 0) return before_;
    return i < static_cast<long>(tour_.size()) ? &tour_[static_cast<std::size_t>(i)] : nullptr;
  }

  bool canTurn(const Step& step) const { return works_[step.work].ways.size() == 2; }
  static Step turned(const Step& step) { return {step.work, 1 - step.way}; }

  /// Drives a part of the tour the other way round where that is shorter.
  bool turnParts() {
    bool improved = false;
    const long n = static_cast<long>(tour_.size());
    for (long i = 0; i < n; ++i) {
      for (long j = i; j < n; ++j) {
        if (!canTurn(tour_[static_cast<std::size_t>(j)])) break;
        const Step first = turned(*at(j)), last = turned(*at(i));
        const double old_price = links_.price(at(i - 1), at(i)) + links_.price(at(j), at(j + 1));
        if (at(i - 1) && (links_.endOf(*at(i - 1)).position() - links_.startOf(first).position()).norm() > old_price) {
          continue;
        }
        const double price = links_.price(at(i - 1), &first) + links_.price(&last, at(j + 1));
        if (price > old_price - 1e-3) continue;
        std::reverse(tour_.begin() + i, tour_.begin() + j + 1);
        for (long k = i; k <= j; ++k) tour_[static_cast<std::size_t>(k)] = turned(tour_[static_cast<std::size_t>(k)]);
        improved = true;
      }
    }
    return improved;
  }

  /// Moves up to kMaxMoved pieces together to another place, turned round or not, where that is shorter.
  bool moveParts() {
    bool improved = false;
    const long n = static_cast<long>(tour_.size());
    for (long count = 1; count <= std::min<long>(kMaxMoved, n - 1); ++count) {
      for (long i = 0; i + count <= n; ++i) improved = movePart(i, count) || improved;
    }
    return improved;
  }

  bool movePart(long i, long count) {
    const long n = static_cast<long>(tour_.size());
    std::vector<Step> part(tour_.begin() + i, tour_.begin() + i + count), back;
    bool turns = true;
    for (auto step = part.rbegin(); step != part.rend(); ++step) {
      turns = turns && canTurn(*step);
      back.push_back(turns ? turned(*step) : *step);
    }
    const double freed = links_.price(at(i - 1), at(i)) + links_.price(at(i + count - 1), at(i + count)) -
                         links_.price(at(i - 1), at(i + count));
    if (freed < 1e-3) return false;
    double best = freed - 1e-3;
    long place = -1;
    bool turn = false;
    for (long j = -1; j < n; ++j) {  // between j and j + 1
      if (j >= i - 1 && j < i + count) continue;
      for (const bool reversed : {false, true}) {
        if (reversed && !turns) continue;
        const std::vector<Step>& piece = reversed ? back : part;
        if (at(j) && (links_.endOf(*at(j)).position() - links_.startOf(piece.front()).position()).norm() >
                         best + links_.price(at(j), at(j + 1))) {
          continue;
        }
        const double price = links_.price(at(j), &piece.front()) + links_.price(&piece.back(), at(j + 1)) -
                             links_.price(at(j), at(j + 1));
        if (price < best) best = price, place = j, turn = reversed;
      }
    }
    if (best > freed - 2e-3) return false;
    const std::vector<Step>& piece = turn ? back : part;
    tour_.erase(tour_.begin() + i, tour_.begin() + i + count);
    const long to = place < i ? place + 1 : place + 1 - count;
    tour_.insert(tour_.begin() + to, piece.begin(), piece.end());
    return true;
  }

  Links& links_;
  const std::vector<Work>& works_;
  const Step* before_;
  Step at_;
  std::vector<Step> tour_;
};

class Tour {
 public:
  Tour(const Field& field, const std::vector<Work>& works, Routes* routes)
      : field_(field), works_(works), links_(field, works, routes) {}

  std::vector<Step> plan() {
    std::vector<std::size_t> swaths, rings, laps;
    for (std::size_t i = 0; i < works_.size(); ++i) {
      (works_[i].lap < 0 ? swaths : works_[i].is_ring ? rings : laps).push_back(i);
    }
    if (!field_.params().headland_first) std::swap(laps, swaths);
    append(laps);
    append(swaths);
    insertCheaply(rings);
    return steps_;
  }

 private:
  const Step* at(long i) const {
    return i < 0 || i >= static_cast<long>(steps_.size()) ? nullptr : &steps_[static_cast<std::size_t>(i)];
  }

  void append(const std::vector<std::size_t>& works) {
    const std::optional<Step> before = steps_.empty() ? std::nullopt : std::optional<Step>(steps_.back());
    const std::vector<Step> tour = SwathTour(&links_, works_, before ? &*before : nullptr).plan(works);
    steps_.insert(steps_.end(), tour.begin(), tour.end());
  }

  void insertCheaply(const std::vector<std::size_t>& rings) {
    for (const std::size_t ring : rings) {
      double best = kInfinity;
      long place = 0;
      Step chosen;
      for (long j = -1; j < static_cast<long>(steps_.size()); ++j) {
        for (std::size_t way = 0; way < works_[ring].ways.size(); ++way) {
          const Step step{ring, way};
          if (at(j) && (links_.endOf(*at(j)).position() - links_.startOf(step).position()).norm() >
                           best + links_.price(at(j), at(j + 1))) {
            continue;
          }
          const double price =
              links_.price(at(j), &step) + links_.price(&step, at(j + 1)) - links_.price(at(j), at(j + 1));
          if (price < best) best = price, place = j, chosen = step;
        }
      }
      steps_.insert(steps_.begin() + place + 1, chosen);
    }
  }

  const Field& field_;
  const std::vector<Work>& works_;
  Links links_;
  std::vector<Step> steps_;
};

}  // namespace

std::vector<Step> orderOf(const Field& field, const std::vector<Work>& works, Routes* routes) {
  return Tour(field, works, routes).plan();
}

}  // namespace external_command
