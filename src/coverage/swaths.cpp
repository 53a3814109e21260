// SPDX-License-Identifier: Apache-2.0
#include "swaths.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "profile.h"
#include "stretches.h"

namespace external_command {

namespace {

constexpr int kBins = 8;        ///< across a swath
constexpr int kCoarseBins = 2;  ///< the same, in the search for a heading
constexpr double kCoarseSpots = 20e3;
constexpr int kHeadings = 24;          ///< tried, besides those of the border's edges
constexpr std::size_t kFinalists = 3;  ///< headings looked at closely

class SwathSearch {
 public:
  SwathSearch(const Field& field, double price, double turn_price, CoverageGrid* grid)
      : field_(field), price_(price), turn_price_(turn_price), grid_(*grid), remains_(grid_, field.width() / kBins) {}

  SwathPlan plan() {
    Layout best;
    for (const double heading : finalists()) {
      field_.cancel().throwIfCancelled();
      const Profile profile(remains_, heading, field_.width() / kBins);
      for (int offset = 0; offset < kBins; ++offset) {
        const Layout layout{heading, offset, worthOf(profile, kBins, offset)};
        if (layout.worth > best.worth) best = layout;
      }
    }
    SwathPlan plan;
    if (best.worth <= 0.0) return plan;
    plan.worth = best.worth;
    plan.works = lay(Profile(remains_, best.heading, field_.width() / kBins), best.offset);
    for (const Work& work : plan.works) grid_.sweep(work.ways.front(), field_.width());
    return plan;
  }

 private:
  /// Parallel lines, `offset` bins off the first possible ones.
  struct Layout {
    double heading = 0.0;
    int offset = 0;
    double worth = 0.0;
  };

  std::vector<double> headings() const {
    if (field_.params().swath_heading) return {*field_.params().swath_heading};
    std::vector<double> all;
    for (const shapes::Shape& shape : field_.workable()) {
      const std::vector<Point2d> points = pointsOf(shape.outer());
      for (std::size_t i = 0; i < points.size(); ++i) {
        const Point2d edge = points[(i + 1) % points.size()] - points[i];
        if (edge.norm() > 4.0 * field_.width()) all.push_back(headingOf(edge));
      }
    }
    for (int i = 0; i < kHeadings; ++i) all.push_back(M_PI * i / kHeadings);
    for (double& heading : all) heading -= M_PI * std::floor(heading / M_PI);
    std::sort(all.begin(), all.end());
    std::vector<double> distinct;
    for (const double heading : all) {
      if (distinct.empty() || heading - distinct.back() > 0.01) distinct.push_back(heading);
    }
    return distinct;
  }

  /// The headings that look best on coarse bins.
  std::vector<double> finalists() const {
    std::vector<double> all = headings();
    if (all.size() <= kFinalists) return all;
    const double bin = field_.width() / kCoarseBins;
    const Remains coarse(remains_, std::max(0.6 * bin, std::sqrt(remains_.area / kCoarseSpots)));
    std::vector<std::pair<double, double>> ranked;  // worth, heading
    for (const double heading : all) {
      const Profile profile(coarse, heading, bin);
      double worth = 0.0;
      for (int offset = 0; offset < kCoarseBins; ++offset) {
        worth = std::max(worth, worthOf(profile, kCoarseBins, offset));
      }
      ranked.emplace_back(-worth, heading);
    }
    std::sort(ranked.begin(), ranked.end());
    all.clear();
    for (std::size_t i = 0; i < kFinalists; ++i) all.push_back(ranked[i].second);
    return all;
  }

  /// Visits each line of a layout: first row of bins, distance across, and worth of each column.
  template <class Visit>
  void visitLines(const Profile& profile, int bins, int offset, const Visit& visit) const {
    const double pitch = (field_.width() - field_.params().overlap) / profile.bin();
    for (double first = -offset; first < profile.rows(); first += pitch) {
      const int row = static_cast<int>(std::lround(first));
      const double across = first * profile.bin() + field_.width() / 2.0;
      visit(across, [&profile, row, bins, across, this](int i) {
        if ((grid_.at(profile.point((i + 0.5) * profile.bin(), across)) & kOpen) == 0) return kNever;
        return price_ * profile.left(i, row, bins) - profile.bin();
      });
    }
  }

  double worthOf(const Profile& profile, int bins, int offset) const {
    double sum = 0.0;
    visitLines(profile, bins, offset, [&](double, const auto& worth) {
      sum += bestStretches(profile.columns(), turn_price_, worth, nullptr);
    });
    return sum;
  }

  std::vector<Work> lay(const Profile& profile, int offset) const {
    std::vector<Work> works;
    visitLines(profile, kBins, offset, [&](double across, const auto& worth) {
      std::vector<Stretch> stretches;
      bestStretches(profile.columns(), turn_price_, worth, &stretches);
      for (const Stretch& stretch : stretches) addSwath(profile, across, stretch, &works);
    });
    return works;
  }

  /// The stretch driven from either end, as far as the vehicle fits.
  void addSwath(const Profile& profile, double across, const Stretch& stretch, std::vector<Work>* works) const {
    const double from = stretch.begin * profile.bin(), to = stretch.end * profile.bin();
    const auto poseAtColumn = [&](double along) {
      const Point2d at = profile.point(along, across);
      return Pose2d{at.x(), at.y(), profile.heading()};
    };
    Work work;
    for (const Pose2d& pose : {poseAtColumn(from), aboutFace(poseAtColumn(to))}) {
      const Curve way = field_.freePart({pose, {{to - from, 0.0}}}, profile.bin());
      if (way.length() > 0.0) work.ways.push_back(way);
    }
    if (!work.ways.empty()) works->push_back(work);
  }

  const Field& field_;
  double price_;
  double turn_price_;
  CoverageGrid& grid_;
  Remains remains_;
};

}  // namespace

SwathPlan planSwaths(const Field& field, double price, double turn_price, CoverageGrid* grid) {
  return SwathSearch(field, price, turn_price, grid).plan();
}

}  // namespace external_command
