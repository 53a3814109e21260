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

constexpr const char* kHeader = "external_command_zone_2";
constexpr std::size_t kMostLines = 100000;  // more means that the file is damaged
constexpr std::size_t kMostArcs = 1000000;

std::string expanded(const std::string& folder) {
  const char* home = std::getenv("HOME");
  if (folder.empty() || folder[0] != '~' || home == nullptr) return folder;
  return home + folder.substr(1);
}

void writeIndices(const std::vector<std::size_t>& indices, std::ostream* file) {
  *file << indices.size();
  for (const std::size_t index : indices) *file << ' ' << index;
  *file << '\n';
}

std::vector<std::size_t> readIndices(std::size_t total, std::istream* file) {
  std::size_t count = 0;
  *file >> count;
  if (count > total) file->setstate(std::ios::failbit);
  std::vector<std::size_t> indices(*file ? count : 0);
  for (std::size_t& index : indices) {
    *file >> index;
    if (index >= total) file->setstate(std::ios::failbit);
  }
  return indices;
}

SwathLine readLine(std::istream* file) {
  SwathLine line;
  std::size_t count = 0;
  *file >> line.start.x >> line.start.y >> line.start.heading >> count;
  if (count > kMostArcs) file->setstate(std::ios::failbit);
  line.arcs.resize(*file ? count : 0);
  for (ArcSegment& arc : line.arcs) *file >> arc.length >> arc.kappa;
  return line;
}

}  // namespace

ZonePlanFile::ZonePlanFile(const std::string& folder, std::uint64_t zone_key) {
  std::ostringstream name;
  name << std::hex << std::setw(16) << std::setfill('0') << zone_key << ".zone";
  path_ = (std::filesystem::path(expanded(folder)) / name.str()).string();
}

std::optional<CoverageProgress> ZonePlanFile::read() const {
  std::ifstream file(path_);
  std::string header;
  std::size_t total = 0;
  file >> header >> total;
  if (!file || header != kHeader || total == 0 || total > kMostLines) return std::nullopt;
  CoverageProgress progress;
  progress.done = readIndices(total, &file);
  progress.skipped = readIndices(total, &file);
  for (std::size_t i = 0; i < total && file; ++i) progress.lines.push_back(readLine(&file));
  if (!file) return std::nullopt;
  return progress;
}

void ZonePlanFile::write(const CoverageProgress& progress) const {
  const std::string temporary = path_ + ".new";
  std::error_code failure;
  std::filesystem::create_directories(std::filesystem::path(path_).parent_path(), failure);
  std::ofstream file(temporary);
  file << std::setprecision(17) << kHeader << ' ' << progress.lines.size() << '\n';
  writeIndices(progress.done, &file);
  writeIndices(progress.skipped, &file);
  for (const SwathLine& line : progress.lines) {
    file << line.start.x << ' ' << line.start.y << ' ' << line.start.heading << ' ' << line.arcs.size();
    for (const ArcSegment& arc : line.arcs) file << ' ' << arc.length << ' ' << arc.kappa;
    file << '\n';
  }
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
  words +=
      text(params.swath_width, ' ', params.overlap, ' ', params.margin, ' ', params.headland_laps, ' ',
           params.headland_first, ' ', params.swath_heading.value_or(-100.0), ' ', static_cast<int>(params.objective),
           ' ', vehicle.width, ' ', vehicle.length(), ' ', vehicle.rear_overhang, ' ', vehicle.min_turning_radius);
  return std::hash<std::string>()(words);
}

}  // namespace external_command
