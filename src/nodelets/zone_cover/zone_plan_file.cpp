// SPDX-License-Identifier: Apache-2.0
#include "zone_plan_file.h"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <system_error>

#include "core/durable_file.h"
#include "external_command/ros/ros_folder.h"
#include "zone_text.h"

namespace external_command {

namespace {

constexpr std::size_t kMostOfName = 40;  // bytes of each part of a file's name

/// FNV-1a (G. Fowler, L. Noll, K.-P. Vo), 64 bits: the same in every build, unlike std::hash.
class Digest {
 public:
  void add(const std::string& words) {
    for (const char c : words) add(static_cast<unsigned char>(c));
    add(0);
  }

  void add(double value, double unit) {
    const auto whole = static_cast<std::uint64_t>(std::llround(value / unit));
    for (int shift = 0; shift < 64; shift += 8) add(static_cast<unsigned char>(whole >> shift));
  }

  /// To the centimetre: a polygon that is given in a moving frame comes out a little different each time.
  void add(const Polygon& polygon) {
    for (const Point2d& point : polygon.points()) {
      add(point.x(), 0.01);
      add(point.y(), 0.01);
    }
    add(std::string());
  }

  std::uint64_t value() const { return value_; }

 private:
  void add(unsigned char byte) { value_ = (value_ ^ byte) * 1099511628211ull; }

  std::uint64_t value_ = 14695981039346656037ull;
};

std::string forFileName(const std::string& name, const char* fallback) {
  std::string result;
  for (const char c : name.substr(0, kMostOfName)) {
    result += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
  }
  return result.empty() ? fallback : result;
}

/// Of a namespace, as zoneKey() puts it in front.
std::string prefixOf(const std::string& vehicle_namespace) {
  const std::size_t begin = vehicle_namespace.find_first_not_of('/');
  return forFileName(begin == std::string::npos ? "" : vehicle_namespace.substr(begin), "root") + "-";
}

}  // namespace

ZoneKey zoneKey(const std::string& vehicle_namespace, const std::string& label, const CoverageArea& area,
                const CoverageParams& params, const VehicleParams& vehicle) {
  Digest digest;
  digest.add(vehicle_namespace);
  digest.add(label);
  digest.add(area.outer);
  for (const Polygon& hole : area.holes) digest.add(hole);
  for (const double value :
       {params.swath_width, params.overlap, params.margin, static_cast<double>(params.headland_laps),
        params.headland_first ? 1.0 : 0.0, params.swath_heading.value_or(-100.0), static_cast<double>(params.objective),
        vehicle.width, vehicle.wheelbase, vehicle.front_overhang, vehicle.rear_overhang, vehicle.min_turning_radius}) {
    digest.add(value, 1e-6);
  }
  return {prefixOf(vehicle_namespace) + forFileName(label, "polygon"), digest.value()};
}

std::string zoneFolder(const std::string& parameter) { return rosFolder(parameter, "external_command"); }

ZonePlanFile::ZonePlanFile(const std::string& folder, const ZoneKey& key) : digest_(key.digest) {
  char digits[17];
  std::snprintf(digits, sizeof digits, "%016llx", static_cast<unsigned long long>(key.digest));
  path_ = (std::filesystem::path(folder) / (key.name + "-" + digits + ".zone")).string();
}

std::optional<CoverageProgress> ZonePlanFile::read() const {
  std::string content;
  if (!durable_file::read(path_, kMostZoneText + 1, &content)) return std::nullopt;
  return parseZone(content, digest_);
}

void ZonePlanFile::setAside() const { durable_file::replace(damagedPath(), path_); }

bool ZonePlanFile::isSetAside() const {
  std::error_code failure;
  return std::filesystem::exists(damagedPath(), failure);
}

std::string ZonePlanFile::temporaryPath() const { return durable_file::temporaryPath(path_); }

void removeLeftovers(const std::string& folder, const std::string& vehicle_namespace) {
  durable_file::removeLeftovers(folder, prefixOf(vehicle_namespace), durable_file::OwnFiles::kLeft);
}

}  // namespace external_command
