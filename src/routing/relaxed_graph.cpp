// SPDX-License-Identifier: Apache-2.0
#include "relaxed_graph.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace external_command {

namespace {

constexpr double kLost = 0.01;  // by which a change that runs over several lanes may be counted short [m]
constexpr int kMaxRounds = 64;  // until lanes whose rates lower each other's without end count nothing

std::int32_t unitsOf(double metres) {
  return static_cast<std::int32_t>(
      std::floor(std::clamp(metres, 0.0, RelaxedGraph::kMaxWeight) * RelaxedGraph::kUnitsPerMetre));
}

/// The metres left on the two lanes of a pair, where it begins and where it ends.
struct Rests {
  double a, b;
};

std::array<Rests, 2> restsOf(const LaneGraph& graph, LaneIndex a, const LanePair& pair) {
  const double length_a = graph.length(a), length_b = graph.length(pair.b);
  return {Rests{length_a - pair.a_from, length_b - pair.b_from}, Rests{length_a - pair.a_to, length_b - pair.b_to}};
}

class Rates {
 public:
  Rates(const LaneGraph& graph, double price) : graph_(graph), price_(price), rates_(graph.size(), 1.0) {}

  std::vector<double> find() {
    for (int round = 0; lowerAll(round >= kMaxRounds); ++round) {
    }
    return std::move(rates_);
  }

 private:
  /// @return whether a rate was too high.
  bool lowerAll(bool to_zero) {
    bool is_lowered = false;
    for (LaneIndex lane = 0; lane < graph_.size(); ++lane) {
      for (const LaneGraph::Neighbour& neighbour : graph_.neighbours(lane)) {
        for (const Rests& rests : restsOf(graph_, lane, neighbour.pair)) {
          const double most = price_ + rates_[neighbour.pair.b] * rests.b;
          if (rates_[lane] * rests.a <= most) continue;
          rates_[lane] = to_zero ? 0.0 : most / rests.a * (1.0 - 1e-9);
          is_lowered = true;
        }
      }
    }
    return is_lowered;
  }

  const LaneGraph& graph_;
  const double price_;
  std::vector<double> rates_;
};

}  // namespace

RelaxedGraph::RelaxedGraph(const LaneGraph& graph, double change_price) {
  const double price = std::max(0.0, change_price - kLost);
  rates = Rates(graph, price).find();
  for (LaneIndex lane = 0; lane < graph.size(); ++lane) {
    for (const LaneGraph::Link& next : graph.successors(lane)) {
      arcs.push_back({lane, next.lane, unitsOf(rates[next.lane] * (graph.length(next.lane) - next.entry))});
    }
  }
  first_change = arcs.size();
  for (LaneIndex lane = 0; lane < graph.size(); ++lane) {
    for (const LaneGraph::Neighbour& neighbour : graph.neighbours(lane)) {
      double weight = RelaxedGraph::kMaxWeight;
      for (const Rests& rests : restsOf(graph, lane, neighbour.pair)) {
        weight = std::min(weight, price + rates[neighbour.pair.b] * rests.b - rates[lane] * rests.a);
      }
      arcs.push_back({lane, neighbour.pair.b, unitsOf(weight)});
    }
  }
}

}  // namespace external_command
