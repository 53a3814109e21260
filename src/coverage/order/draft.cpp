// SPDX-License-Identifier: Apache-2.0
#include "draft.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "coverage/work/laps.h"
#include "coverage/work/parts.h"
#include "coverage/work/swaths.h"

namespace external_command {

namespace {

constexpr double kTurn = 1.3;        ///< price of a turn, in half circles: about what finished plans take
constexpr double kFewerTurns = 5.0;  ///< how much dearer a turn is where few are wanted
constexpr std::size_t kHeadingsKept = 4;
constexpr double kCorridor = 10.0;  ///< swaths across an area that is so narrow in the mean that laps alone are tried
constexpr int kMostLaps = 50;       ///< of these
constexpr double kTimeForLaps = 0.15;  ///< share of the budget after which no more laps are tried
constexpr double kLapsInAll = 4e4;     ///< how many laps are tried: fewer on large fields, where each takes longer

/// Of a turn on a headland of so many laps: it takes changes of gear where there is no room for half a circle.
double turnPrice(const Field& field, int laps) {
  const VehicleParams& vehicle = field.vehicle();
  const double room = std::hypot(field.radius() + vehicle.width / 2.0, field.front()) + field.params().margin;
  const bool has_room = laps * (field.width() - field.params().overlap) >= room;
  const double price = kTurn * M_PI * field.radius() + (has_room ? 0.0 : 2.0 * field.gearPrice());
  return field.params().objective == CoverageObjective::kFewestTurns ? kFewerTurns * price : price;
}

/// Of a shape that is taken for one long corridor [m].
double meanWidth(const shapes::Shapes& shapes) {
  double border = 0.0;
  for (const shapes::Shape& shape : shapes) border += borderLengthOf(shape);
  return 2.0 * areaOf(shapes) / std::max(border, 1e-9);
}

/// So many that the rear axle gets to the end of a swath with the nose still inside.
int lapsForTheNose(const Field& field) {
  return static_cast<int>(std::ceil((field.front() + field.params().margin) / field.width()));
}

/// With every number of laps.
std::vector<Draft> draftsFor(const Field& field, const CoverageGrid& empty, double price, double swing) {
  const int wanted = field.params().headland_laps;
  const int nose = lapsForTheNose(field), least = wanted >= 0 ? wanted : std::max(1, nose - 1);
  const double swaths = areaOf(field.goal()) / (field.width() * field.width());
  const int most = wanted >= 0 ? wanted : least + std::clamp(static_cast<int>(kLapsInAll / swaths), 1, 30);
  std::vector<double> headings = swathHeadings(field);
  std::vector<Draft> drafts;
  Draft draft{0, swing, 0.0, {}, empty, {}};
  double length = 0.0;
  for (;; ++draft.laps) {
    field.poll();
    const SwathPrices prices{price, turnPrice(field, draft.laps)};
    if (draft.laps >= least) {
      draft.headings = rankHeadings(field, prices, draft.grid, headings);
      draft.cost = length - price * draft.grid.area(kGoal | kSwept, 0) - draft.headings.front().worth;
      drafts.push_back(draft);
      headings.clear();  // what is good for the outer part is good for the inner one
      for (const SwathHeading& ranked : draft.headings) {
        if (headings.size() < kHeadingsKept) headings.push_back(ranked.heading);
      }
    }
    if (draft.laps == most || (!drafts.empty() && field.timeUsed() > kTimeForLaps)) break;
    const std::vector<Work> laps = planLap(field, draft.laps, {wanted >= 0 ? wanted : nose, swing}, price, &draft.grid);
    if (laps.empty()) break;
    for (const Work& lap : laps) {
      const Curve way = lap.curveOf(0);
      length += way.length() + field.gearPrice() * way.gearChanges() + turnPrice(field, most) / 2.0;
      draft.works.push_back(lap);
    }
  }
  if (drafts.empty()) {
    draft.headings = rankHeadings(field, {price, turnPrice(field, draft.laps)}, draft.grid, headings);
    drafts.push_back(draft);
  }
  return drafts;
}

}  // namespace

std::vector<Draft> makeDrafts(const Field& field, const CoverageGrid& empty, double price, std::size_t count) {
  std::vector<std::vector<Draft>> bySwing;
  for (const double swing : swingsOf(field)) {
    bySwing.push_back(draftsFor(field, empty, price, swing));
    std::stable_sort(bySwing.back().begin(), bySwing.back().end(),
                     [](const Draft& a, const Draft& b) { return a.cost < b.cost; });
  }
  std::vector<Draft> drafts;
  for (std::size_t place = 0; place < count; ++place) {
    for (std::vector<Draft>& some : bySwing) {
      if (place < some.size()) drafts.push_back(std::move(some[place]));
    }
  }
  return drafts;
}

std::vector<Draft> draftsOfLaps(const Field& field, const CoverageGrid& empty, double price) {
  if (field.params().headland_laps >= 0 || meanWidth(field.goal()) > kCorridor * field.width()) return {};
  std::vector<Draft> drafts;
  for (const double swing : swingsOf(field)) {
    Draft draft{0, swing, 0.0, {}, empty, {}};
    for (; draft.laps < kMostLaps; ++draft.laps) {
      field.poll();
      const std::vector<Work> laps = planLap(field, draft.laps, {1, swing, true}, price, &draft.grid);
      if (laps.empty()) break;
      draft.works.insert(draft.works.end(), laps.begin(), laps.end());
    }
    draft.headings = rankHeadings(field, {price, turnPrice(field, draft.laps)}, draft.grid, swathHeadings(field));
    drafts.push_back(std::move(draft));
  }
  return drafts;
}

std::vector<Work> worksOf(const Field& field, Draft draft, double price, double choosy) {
  const SwathPrices prices{price, choosy * turnPrice(field, draft.laps)};
  for (Work& work : planSwaths(field, prices, draft.headings, &draft.grid)) draft.works.push_back(work);
  return std::move(draft.works);
}

std::vector<Part> partsOf(const Field& field, const Draft& draft, double price) {
  return divided(field, {price, turnPrice(field, draft.laps)}, draft.grid);
}

std::vector<Work> worksOf(const Field& field, Draft draft, double price, const std::vector<Part>& parts) {
  const SwathPrices prices{price, turnPrice(field, draft.laps)};
  for (const Part& part : parts) {
    const auto headings = rankHeadings(field, prices, draft.grid, swathHeadings(field), part);
    for (Work& work : planSwaths(field, prices, headings, &draft.grid, part)) draft.works.push_back(work);
  }
  return std::move(draft.works);
}

}  // namespace external_command
