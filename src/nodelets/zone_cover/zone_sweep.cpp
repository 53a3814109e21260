// SPDX-License-Identifier: Apache-2.0
#include "zone_sweep.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

/// Its first `points` points, which lie about as far apart as the others.
void cutFront(std::size_t points, Swath* swath) {
  const double share = static_cast<double>(points) / static_cast<double>(swath->last - swath->first);
  swath->from += share * swath->length;
  swath->length -= share * swath->length;
  swath->covered.erase(swath->covered.begin(), swath->covered.begin() + static_cast<long>(points));
  const double before = swath->covered.front();
  for (double& area : swath->covered) area -= before;
  swath->covered_area -= before;
}

/// What lies beyond `last`, a point of `path`.
void cutBack(const Path& path, std::size_t last, Swath* swath) {
  const double start = path[swath->first].s;
  swath->length *= (path[last].s - start) / (path[swath->last].s - start);
  swath->covered.resize(last - swath->first + 1);
  swath->covered_area = swath->covered.back();
  swath->last = last;
}

std::vector<Swath> shifted(std::vector<Swath> swaths, std::ptrdiff_t points) {
  std::vector<Swath> kept;
  for (Swath& swath : swaths) {
    const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(swath.first) + points;
    const std::ptrdiff_t last = static_cast<std::ptrdiff_t>(swath.last) + points;
    if (last <= 0) continue;
    if (first < 0) cutFront(static_cast<std::size_t>(-first), &swath);
    swath.first = static_cast<std::size_t>(std::max<std::ptrdiff_t>(first, 0));
    swath.last = static_cast<std::size_t>(last);
    kept.push_back(std::move(swath));
  }
  return kept;
}

/// The point of `path` that `point` is a copy of.
std::optional<std::size_t> indexOf(const Path& path, const ReferencePoint& point) {
  const auto isBefore = [](const ReferencePoint& a, const ReferencePoint& b) { return a.s < b.s; };
  const auto found = std::lower_bound(path.begin(), path.end(), point, isBefore);
  const bool is_it = found != path.end() && found->s == point.s && found->x == point.x && found->y == point.y;
  return is_it ? std::optional(static_cast<std::size_t>(found - path.begin())) : std::nullopt;
}

}  // namespace

ZoneTask taskOf(CoverageProgress progress, const CoverageResult& coverage, std::size_t offset) {
  ZoneTask task{std::move(progress), coverage.swaths, coverage.covered_area, coverage.reachable_area};
  for (Swath& swath : task.swaths) {
    swath.first += offset;
    swath.last += offset;
    task.covered_before -= swath.covered_area;
  }
  task.covered_before = std::max(0.0, task.covered_before);
  return task;
}

void putInFront(std::vector<Swath> swaths, const Path& approach, ZoneTask* task) {
  for (const Swath& swath : swaths) task->covered_before = std::max(0.0, task->covered_before - swath.covered_area);
  task->approach = std::move(swaths);
  task->approach_end = approach.empty() ? 0 : approach.size() - 1;
}

void shiftPoints(std::ptrdiff_t points, ZoneTask* task) {
  std::vector<Swath> swaths =
      shifted(std::move(task->approach), points - static_cast<std::ptrdiff_t>(task->approach_end));
  std::vector<Swath> planned = shifted(std::move(task->swaths), points);
  swaths.insert(swaths.end(), std::make_move_iterator(planned.begin()), std::make_move_iterator(planned.end()));
  task->swaths = std::move(swaths);
  task->approach.clear();
}

ZoneSweep::ZoneSweep(ZoneTask task, std::shared_ptr<const Path> path)
    : task_(std::move(task)), path_(std::move(path)), tracker_(path_, task_.swaths) {
  if (task_.swaths.empty()) throw InternalError("a zone is to be swept by a path without swaths");
}

bool ZoneSweep::follow(const Pose2d& vehicle) {
  tracker_.update(vehicle);
  return keep();
}

bool ZoneSweep::finish() {
  tracker_.finish();
  return keep();
}

bool ZoneSweep::keep() {
  bool is_news = false;
  const std::size_t end = std::min(tracker_.current() + 1, task_.swaths.size());
  for (std::size_t i = 0; i < end; ++i) {
    is_news = task_.progress.sweep(task_.swaths[i].index, tracker_.sweptOf(i)) || is_news;
  }
  return is_news;
}

bool ZoneSweep::takeOver(const CoverageProgress& earlier) {
  const std::vector<double> before = task_.progress.swept;
  task_.progress.merge(earlier);
  return task_.progress.swept != before;
}

std::vector<Swath> ZoneSweep::swathsOn(const Path& stretch) const {
  if (stretch.empty()) return {};
  const std::optional<std::size_t> first = indexOf(*path_, stretch.front()), last = indexOf(*path_, stretch.back());
  if (!first || !last || *last - *first + 1 != stretch.size()) return {};
  std::vector<Swath> swaths;
  for (Swath swath : task_.swaths) {
    if (swath.first >= *last || swath.last <= *first) continue;
    if (swath.last > *last) cutBack(*path_, *last, &swath);
    swaths.push_back(std::move(swath));
  }
  return shifted(std::move(swaths), -static_cast<std::ptrdiff_t>(*first));
}

std::string ZoneSweep::words() const {
  const std::vector<SwathLine>& lines = task_.progress.lines;
  const std::size_t current = std::min(tracker_.current(), task_.swaths.size() - 1);
  const std::size_t index = task_.swaths[current].index;
  const double covered = task_.covered_before + tracker_.coveredArea();
  const int percent = static_cast<int>(100.0 * std::min(covered / std::max(task_.goal_area, 1e-9), 1.0));
  std::string words = text("swath ", index + 1, " of ", lines.size(), ", ", percent, " % covered");
  if (!lines[index].isLap()) return words;
  const auto isLap = [](const SwathLine& line) { return line.isLap(); };
  const auto here = lines.begin() + static_cast<long>(index) + 1;
  return words + text(" (lap ", std::count_if(lines.begin(), here, isLap), " of ",
                      std::count_if(lines.begin(), lines.end(), isLap), ")");
}

}  // namespace external_command
