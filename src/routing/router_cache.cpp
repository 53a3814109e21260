// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/router_cache.h"

#include <boost/version.hpp>
#include <filesystem>
#include <limits>
#include <sstream>
#include <system_error>

#include "core/block_file.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "external_command/map_sources.h"
#include "map/map_archive.h"
#include "router_content.h"

BOOST_IS_BITWISE_SERIALIZABLE(external_command::ContractionHierarchy::Arc)

namespace external_command {

namespace {

namespace fs = std::filesystem;

/// What the kept router is not, and why.
class Outdated : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr const char* kEnding = ".cache";

/// Words of a label, in their order.
enum Word : std::size_t { kProgram, kParameters, kContent, kWords };

/// Changes with each source of what is kept, and with how compilers lay it out.
std::string programWords() {
  return text(kMapSources, " boost ", BOOST_VERSION, " sizes ", sizeof(void*), " ", sizeof(ContractionHierarchy::Arc),
              " ", mapArchiveLayout());
}

/// All on which what is kept depends, to the last digit; the other parameters of a router count in each search alone.
std::string parameterWords(const RouterSource& source) {
  std::ostringstream out;
  out.precision(std::numeric_limits<double>::max_digits10);
  const MapOrigin& origin = source.origin;
  out << static_cast<int>(origin.kind);
  if (origin.kind == MapOrigin::Kind::kGiven) out << ' ' << origin.point.x() << ' ' << origin.point.y();
  out << ' ' << source.map.max_link_gap << ' ' << source.map.max_segment_length << ' '
      << source.router.lane_change_price;
  return out.str();
}

BlockFileLabel labelOf(const RouterSource& source, std::uint64_t content) {
  return {programWords(), parameterWords(source), hexadecimal(content)};
}

void requireLabel(const BlockFileLabel& label, const RouterSource& source) {
  if (label.size() != kWords || label[kProgram] != programWords()) {
    throw Outdated("another version of this program wrote it, or one for another kind of machine");
  }
  if (label[kParameters] != parameterWords(source)) {
    throw Outdated(
        "it was made with other parameters (~map_origin, ~map/max_link_gap, ~map/max_segment_length, "
        "~routing/lane_change_price)");
  }
  if (label[kContent] != hexadecimal(contentDigestOfFile(source.map_file))) {
    throw Outdated("the map file has changed since");
  }
}

std::string nameOf(const std::string& map_file) {
  std::error_code failure;
  fs::path path = fs::canonical(map_file, failure);
  if (failure) path = fs::absolute(map_file, failure);
  return path.stem().string() + "-" + hexadecimal(digestOf(path.c_str(), path.string().size())) + kEnding;
}

/// Never set back: by a clock that stands far behind what is read now would soon be taken for unused.
void markUsed(const std::string& path) {
  std::error_code failure;
  const fs::file_time_type now = fs::file_time_type::clock::now();
  if (fs::last_write_time(path, failure) < now && !failure) fs::last_write_time(path, now, failure);
}

bool wasUnused(const fs::directory_entry& file) {
  std::error_code failure;
  const fs::file_time_type used = file.last_write_time(failure);
  return !failure && fs::file_time_type::clock::now() - used > RouterCache::kUnused;
}

/// Whether RouterCache has written, or begun to write, the file: the folder may hold others.
bool isKeptRouter(const fs::directory_entry& file) {
  std::error_code failure;
  if (!fs::is_regular_file(file.symlink_status(failure))) return false;
  const std::string name = file.path().filename().string();
  if (name.find(text(kEnding, ".")) != std::string::npos && file.path().extension() == ".new") return true;
  if (file.path().extension() != kEnding) return false;
  try {
    return BlockReader(file.path().string()).label().size() == kWords;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

RouterCache::RouterCache(const std::string& folder, RouterSource source)
    : folder_(folder),
      source_(std::move(source)),
      name_(nameOf(source_.map_file)),
      path_((fs::path(folder) / name_).string()) {}

bool RouterCache::isWorthwhile() const {
  std::error_code failure;
  const std::uintmax_t size = fs::file_size(source_.map_file, failure);
  return !failure && size >= kLeastMapSize && !source_.map.keep_findings;
}

RouterCache::Answer RouterCache::read() const {
  Answer answer;
  std::error_code failure;
  if (fs::symlink_status(path_, failure).type() == fs::file_type::not_found) return answer;
  try {
    answer.router = routerOfFile();
    markUsed(path_);
  } catch (const Outdated& reason) {
    answer.why_not = reason.what();
  } catch (const Error& error) {
    answer.why_not = error.what();
    answer.is_damaged = true;
  }
  return answer;
}

std::shared_ptr<const Router> RouterCache::routerOfFile() const {
  BlockReader in(path_);
  requireLabel(in.label(), source_);
  MapContent content(false);
  RouteIndex index;
  readMapContentLater(&in, &content);
  index.forEachArray([&](auto& array) { in.arrayLater(&array); });
  in.finish();
  fillTables(&content);
  auto map = std::make_shared<const HdMap>(std::move(content));
  return std::make_shared<const Router>(
      std::make_unique<const RouterContent>(std::move(map), source_.router, std::move(index)));
}

void RouterCache::write(const Router& router, const CancelToken& cancel) const {
  durable_file::removeLeftovers(folder_, name_, durable_file::OwnFiles::kInUse);
  const std::string temporary = durable_file::temporaryPath(path_);
  std::error_code failure;
  const std::uintmax_t map_size = fs::file_size(source_.map_file, failure);
  if (!failure) durable_file::requireRoom(temporary, 2 * map_size);  // about as much as the map is written
  const MapContent& map = router.map().content();
  BlockWriter out(temporary, cancel);
  writeMapContent(map, &out);
  router.content().index.forEachArray([&](const auto& array) { out.array(array); });
  out.finish(labelOf(source_, map.file_digest));
  try {
    durable_file::replace(path_, temporary);
  } catch (...) {
    durable_file::remove(temporary);
    throw;
  }
}

std::vector<std::string> RouterCache::removeUnused() const {
  std::vector<std::string> removed;
  std::error_code failure;
  for (fs::directory_iterator file(folder_, failure), end; !failure && file != end; file.increment(failure)) {
    const std::string path = file->path().string();
    if (path == path_ || !wasUnused(*file) || !isKeptRouter(*file)) continue;
    durable_file::remove(path);
    removed.push_back(path);
  }
  return removed;
}

}  // namespace external_command
