// SPDX-License-Identifier: Apache-2.0
#include "draft.h"

#include <algorithm>
#include <cmath>

#include "grid.h"
#include "laps.h"
#include "swaths.h"

namespace external_command {

namespace {

constexpr int kMaxRounds = 5;        ///< of swaths, each for what the ones before have left
constexpr int kPatience = 3;         ///< laps that make it worse before no more are tried
constexpr double kTurn = 1.1;        ///< price of a turn, in half circles
constexpr double kFewerTurns = 5.0;  ///< how much dearer a turn is where few are wanted

class Drafter {
 public:
  Drafter(const Field& field, double price) : field_(field), price_(price), grid_(field.makeGrid()) {}

  std::vector<Draft> make() {
    const int wanted = field_.params().headland_laps;
    const int least = wanted >= 0 ? wanted : lapsForTheNose();
    std::vector<Draft> drafts;
    int worse = 0;
    for (int laps = 0; laps <= most(least) && worse < kPatience; ++laps) {
      field_.cancel().throwIfCancelled();
      if (laps > 0 && !addLap(laps - 1, least)) break;
      if (laps < least) continue;
      drafts.push_back(withSwaths());
      drafts.back().laps = laps;
      const auto cheaper = [](const Draft& a, const Draft& b) { return a.cost < b.cost; };
      worse = std::min_element(drafts.begin(), drafts.end(), cheaper) == drafts.end() - 1 ? 0 : worse + 1;
    }
    if (drafts.empty()) drafts.push_back(withSwaths());
    std::stable_sort(drafts.begin(), drafts.end(), [](const Draft& a, const Draft& b) { return a.cost < b.cost; });
    return drafts;
  }

 private:
  /// So many that the rear axle gets to the end of a swath with the nose still inside.
  int lapsForTheNose() const {
    return static_cast<int>(std::ceil((field_.front() + field_.params().margin) / field_.width()));
  }

  int most(int least) const {
    if (field_.params().headland_laps >= 0) return least;
    const double swaths = areaOf(field_.goal()) / (field_.width() * field_.width());
    return least + std::clamp(static_cast<int>(2e4 / swaths), 1, 12);
  }

  double turnPrice() const {
    const double price = kTurn * M_PI * field_.radius() + 2.0 * field_.params().gear_change_cost;
    return field_.params().objective == CoverageObjective::kFewestTurns ? kFewerTurns * price : price;
  }

  bool addLap(int number, int around_holes) {
    const std::vector<Work> laps = planLap(field_, number, around_holes, price_, &grid_);
    for (const Work& lap : laps) {
      lap_length_ += lap.ways.front().length() + turnPrice() / 2.0;
      laps_.push_back(lap);
    }
    return !laps.empty();
  }

  Draft withSwaths() const {
    Draft draft;
    draft.works = laps_;
    draft.cost = lap_length_ - price_ * grid_.area(kGoal | kSwept, 0);
    CoverageGrid grid = grid_;
    for (int round = 0; round < kMaxRounds; ++round) {
      const SwathPlan plan = planSwaths(field_, price_, (round == 0 ? 1.0 : 1.5) * turnPrice(), &grid);
      if (plan.works.empty()) break;
      draft.cost -= plan.worth;
      draft.works.insert(draft.works.end(), plan.works.begin(), plan.works.end());
    }
    return draft;
  }

  const Field& field_;
  double price_;
  CoverageGrid grid_;
  double lap_length_ = 0.0;
  std::vector<Work> laps_;
};

}  // namespace

std::vector<Draft> makeDrafts(const Field& field, double price) { return Drafter(field, price).make(); }

}  // namespace external_command
