// SPDX-License-Identifier: Apache-2.0
#include "zone_plan_file.h"

#include <pwd.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "durable_file.h"
#include "zone_text.h"

namespace external_command {

namespace {

constexpr std::size_t kMostOfName = 40;  // bytes of each part of a file's name
constexpr const char* kTemporary = ".new";

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

std::string homeFolder() {
  if (const char* const home = std::getenv("HOME")) return home;
  passwd entry{};
  passwd* found = nullptr;
  char buffer[4096];
  return getpwuid_r(getuid(), &entry, buffer, sizeof buffer, &found) == 0 && found ? found->pw_dir : "/";
}

/// Whether the process that wrote NAME.PID-N.new may still be at it.
bool isInUse(const std::string& name) {
  const std::size_t dot = name.rfind('.', name.size() - std::string(kTemporary).size() - 1);
  const long pid = dot == std::string::npos ? 0 : std::atol(name.c_str() + dot + 1);
  return pid > 0 && pid != getpid() && (kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM);
}

bool endsWith(const std::string& name, const std::string& end) {
  return name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
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

std::string zoneFolder(const std::string& parameter) {
  if (parameter.empty()) {
    const char* const ros_home = std::getenv("ROS_HOME");
    return (ros_home != nullptr && *ros_home != '\0' ? std::string(ros_home) : homeFolder() + "/.ros") +
           "/external_command";
  }
  const bool is_home = parameter == "~" || parameter.compare(0, 2, "~/") == 0;
  return is_home ? homeFolder() + parameter.substr(1) : parameter;
}

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

std::string ZonePlanFile::temporaryPath() const {
  static std::atomic<unsigned> count{0};
  return path_ + "." + std::to_string(getpid()) + "-" + std::to_string(++count) + kTemporary;
}

void removeLeftovers(const std::string& folder, const std::string& vehicle_namespace) {
  const std::string prefix = prefixOf(vehicle_namespace);
  std::error_code failure;
  for (std::filesystem::directory_iterator file(folder, failure), end; !failure && file != end;
       file.increment(failure)) {
    const std::string name = file->path().filename().string();
    if (name.compare(0, prefix.size(), prefix) != 0 || !endsWith(name, kTemporary) || isInUse(name)) continue;
    durable_file::remove(file->path().string());
  }
}

}  // namespace external_command
