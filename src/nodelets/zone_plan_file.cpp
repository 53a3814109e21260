// SPDX-License-Identifier: Apache-2.0
#include "zone_plan_file.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iomanip>
#include <sstream>
#include <system_error>

#include "external_command/core/error.h"
#include "external_command/core/text.h"

namespace external_command {

namespace {

constexpr const char* kHeader = "external_command_zone_1";

std::string expanded(const std::string& folder) {
  const char* home = std::getenv("HOME");
  if (folder.empty() || folder[0] != '~' || home == nullptr) return folder;
  return home + folder.substr(1);
}

}  // namespace

ZonePlanFile::ZonePlanFile(const std::string& folder, std::uint64_t zone_key) {
  std::ostringstream name;
  name << std::hex << std::setw(16) << std::setfill('0') << zone_key << ".zone";
  path_ = (std::filesystem::path(expanded(folder)) / name.str()).string();
}

std::optional<ZoneProgress> ZonePlanFile::read() const {
  std::ifstream file(path_);
  std::string header;
  ZoneProgress progress;
  file >> header >> progress.planned_from.x >> progress.planned_from.y >> progress.planned_from.heading >>
      progress.done_swaths >> progress.total_swaths;
  const bool is_whole = file && header == kHeader && progress.planned_from.isFinite();
  if (!is_whole || progress.done_swaths > progress.total_swaths) return std::nullopt;
  return progress;
}

void ZonePlanFile::write(const ZoneProgress& progress) const {
  const std::string temporary = path_ + ".new";
  std::error_code failure;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), failure);
  std::ofstream file(temporary);
  file << std::setprecision(17) << kHeader << '\n'
       << progress.planned_from.x << ' ' << progress.planned_from.y << ' ' << progress.planned_from.heading << '\n'
       << progress.done_swaths << ' ' << progress.total_swaths << '\n';
  file.close();
  if (file) std::filesystem::rename(temporary, path_, failure);
  if (!file || failure) {
    throw InternalError(
        text("the progress of the zone cannot be kept in ", path_, "; is the folder (~progress_folder) ", "writable?"));
  }
}

std::uint64_t zoneKey(const CoverageArea& area, const CoverageParams& params, const VehicleParams& vehicle) {
  std::string words;
  const auto add = [&](const Polygon& polygon) {
    for (const Point2d& point : polygon.points()) words += at(point);
    words += ';';
  };
  add(area.outer);
  for (const Polygon& hole : area.holes) add(hole);
  words += text(params.swath_width, ' ', params.overlap, ' ', params.margin, ' ', params.headland_laps, ' ',
                params.headland_first, ' ', params.swath_heading.value_or(-100.0), ' ',
                static_cast<int>(params.objective), ' ', params.seed, ' ', vehicle.width, ' ', vehicle.length(), ' ',
                vehicle.rear_overhang, ' ', vehicle.min_turning_radius);
  return std::hash<std::string>()(words);
}

}  // namespace external_command
