// SPDX-License-Identifier: Apache-2.0
#include "swaths.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "access.h"
#include "bypass.h"
#include "evasion.h"
#include "line_search.h"

namespace external_command {

namespace {

constexpr int kBins = 6;               ///< across a swath, unless the cells of the grid are larger
constexpr int kCoarseBins = 2;         ///< across a line, in the search for a heading
constexpr double kCoarseSpots = 20e3;  ///< in that search, about; on large fields a line stands for several swaths
constexpr int kHeadings = 24;          ///< tried, besides those of the border's edges
constexpr std::size_t kPromising = 8;  ///< headings that are looked at again, with lines in between
constexpr double kDistinct = 0.01;     ///< headings closer than this are one [rad]
constexpr std::size_t kFinalists = 2;  ///< headings looked at closely

int binsFor(const Field& field, const CoverageGrid& grid) {
  return std::clamp(static_cast<int>(field.width() / grid.cell() + 1e-6), kCoarseBins, kBins);
}

class SwathSearch {
 public:
  SwathSearch(const Field& field, const SwathPrices& prices, const CoverageGrid& grid, const Part& part)
      : field_(field),
        bypasses_(field, grid),
        grid_(grid),
        prices_(prices),
        bins_(binsFor(field, grid)),
        remains_(grid, field.width() / bins_, part) {}

  std::vector<SwathHeading> rank(const std::vector<double>& headings) const {
    const double fine = field_.width() / kCoarseBins, block = std::sqrt(remains_.area / kCoarseSpots);
    const double swaths = std::max(1.0, block / fine), bin = swaths * fine;
    const Remains coarse(remains_, std::max(0.6 * fine, block));
    const LineSearch search(field_, prices_, grid_, swaths);
    std::vector<SwathHeading> ranked;
    const auto rankBy = [&](int offsets) {
      for (SwathHeading& entry : ranked) {
        field_.poll();
        const Profile profile(coarse, entry.heading, bin);
        for (int offset = 0; offset < offsets; ++offset) {
          entry.worth = std::max(entry.worth, search.worthOf(profile, kCoarseBins, offset));
        }
      }
      const auto better = [](const SwathHeading& a, const SwathHeading& b) { return a.worth > b.worth; };
      std::stable_sort(ranked.begin(), ranked.end(), better);
    };
    for (const double heading : headings) ranked.push_back({heading, 0.0});
    if (ranked.size() > kPromising) {
      rankBy(1);
      ranked.resize(kPromising);
    }
    rankBy(kCoarseBins);
    return ranked;
  }

  std::vector<Work> plan(const std::vector<SwathHeading>& headings) const {
    const LineSearch search(field_, prices_, grid_);
    std::optional<Profile> best;
    double most = 0.0;
    int best_offset = 0;
    for (std::size_t i = 0; i < std::min(kFinalists, headings.size()); ++i) {
      field_.poll();
      Profile profile(remains_, headings[i].heading, field_.width() / bins_);
      const double before = most;
      for (int offset = 0; offset < bins_; ++offset) {
        const double worth = search.worthOf(profile, bins_, offset);
        if (worth > most) most = worth, best_offset = offset;
      }
      if (most > before) best = std::move(profile);
    }
    return best ? lay(search, *best, best_offset) : std::vector<Work>();
  }

 private:
  /// Swaths on parallel lines, `offset` bins off the first possible ones.
  std::vector<Work> lay(const LineSearch& search, const Profile& profile, int offset) const {
    std::vector<Work> works;
    search.visitLines(profile, bins_, offset, [&](double across, double, const StretchSearch& line) {
      for (const Stretch& stretch : line.stretches()) addSwath(profile, across, stretch, &works);
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
    if (!isOpen(profile, across, stretch)) {
      for (Work& work : evadingSwaths(field_, poseAtColumn(from), to - from, profile.bin())) {
        works->push_back(std::move(work));
      }
      return;
    }
    std::vector<Curve> ways;
    for (const Pose2d& pose : {poseAtColumn(from), aboutFace(poseAtColumn(to))}) {
      const Curve way = accessiblePart(field_, field_.freePart({pose, {{to - from, 0.0}}}, profile.bin()));
      if (way.length() > 0.0) ways.push_back(way);
    }
    if (!ways.empty()) works->emplace_back(ways);
  }

  bool isOpen(const Profile& profile, double across, const Stretch& stretch) const {
    int column = stretch.begin;
    while (column < stretch.end && bypasses_.isOpen(profile, across, column)) ++column;
    return column == stretch.end;
  }

  const Field& field_;
  BypassSearch bypasses_;
  const CoverageGrid& grid_;
  SwathPrices prices_;
  int bins_;
  Remains remains_;
};

}  // namespace

std::vector<double> swathHeadings(const Field& field) {
  if (field.params().swath_heading) return {*field.params().swath_heading};
  std::vector<double> all;
  for (const shapes::Shape& shape : field.workable()) {
    const std::vector<Point2d> points = pointsOf(shape.outer());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Point2d edge = points[(i + 1) % points.size()] - points[i];
      if (edge.norm() > 4.0 * field.width()) all.push_back(headingOf(edge));
    }
  }
  for (int i = 0; i < kHeadings; ++i) all.push_back(M_PI * i / kHeadings);
  for (double& heading : all) heading -= M_PI * std::floor(heading / M_PI);
  std::sort(all.begin(), all.end());
  std::vector<double> distinct;
  for (const double heading : all) {
    if (distinct.empty() || heading - distinct.back() > kDistinct) distinct.push_back(heading);
  }
  return distinct;
}

std::vector<SwathHeading> rankHeadings(const Field& field, const SwathPrices& prices, const CoverageGrid& grid,
                                       const std::vector<double>& headings, const Part& part) {
  return SwathSearch(field, prices, grid, part).rank(headings);
}

std::vector<Work> planSwaths(const Field& field, const SwathPrices& prices, const std::vector<SwathHeading>& headings,
                             CoverageGrid* grid, const Part& part) {
  std::vector<Work> works = SwathSearch(field, prices, *grid, part).plan(headings);
  for (const Work& work : works) grid->sweep(work.curveOf(0), field.width());
  return works;
}

}  // namespace external_command
