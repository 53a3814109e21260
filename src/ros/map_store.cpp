// SPDX-License-Identifier: Apache-2.0
#include "external_command/ros/map_store.h"

#include <ros/console.h>
#include <ros/time.h>

#include <map>
#include <mutex>
#include <system_error>
#include <thread>

#include "external_command/core/text.h"
#include "thread_priority.h"

namespace external_command {

namespace {

double secondsSince(const ros::WallTime& begin) { return (ros::WallTime::now() - begin).toSec(); }

/// A router, and what keeps it for the next start.
class LoadedRouter {
 public:
  LoadedRouter(const RouterSource& source, const std::string& cache_folder)
      : file_(source.map_file), cache_(cache_folder, source) {
    const bool is_cached = !cache_folder.empty() && cache_.isWorthwhile();
    const ros::WallTime begin = ros::WallTime::now();
    if (is_cached) readCache();
    const bool is_known = router_ != nullptr;
    if (!is_known) router_ = std::make_shared<const Router>(readMap(file_, source.origin, source.map), source.router);
    tell(begin, is_known);
    if (is_cached && !is_known) startWriter();
  }

  ~LoadedRouter() {
    stop_.cancel();
    if (writer_.joinable()) writer_.join();
  }

  LoadedRouter(const LoadedRouter&) = delete;
  LoadedRouter& operator=(const LoadedRouter&) = delete;

  const Router* router() const { return router_.get(); }

 private:
  void readCache() {
    RouterCache::Answer answer = cache_.read();
    router_ = std::move(answer.router);
    if (answer.why_not.empty()) return;
    const std::string words =
        text("map ", file_, ": its cache ", cache_.path(), " is not used, and written anew: ", answer.why_not);
    if (answer.is_damaged) {
      ROS_WARN_STREAM(words);
    } else {
      ROS_INFO_STREAM(words);
    }
  }

  void tell(const ros::WallTime& begin, bool is_known) const {
    const HdMap& map = router_->map();
    for (const MapWarning& warning : map.warnings()) ROS_WARN_STREAM("map " << file_ << ": " << warning.what);
    ROS_INFO_STREAM("map " << file_ << ": " << map.lanes().size() << " lanes, " << map.parkingSpaces().size()
                           << " parking spaces, " << map.areas().size() << " areas, origin " << at(map.origin())
                           << ", loaded in " << secondsSince(begin) << " s"
                           << (is_known ? " from its cache " + cache_.path() : std::string()));
  }

  void startWriter() {
    try {
      writer_ = std::thread([this] { write(); });
    } catch (const std::system_error& error) {
      tellNotKept(error);
    }
  }

  void write() const {
    lowerThreadPriority();
    const ros::WallTime begin = ros::WallTime::now();
    try {
      cache_.write(*router_, stop_.token());
      ROS_INFO_STREAM("map " << file_ << ": kept for the next start in " << cache_.path() << ", written in "
                             << secondsSince(begin) << " s");
      for (const std::string& path : cache_.removeUnused()) {
        ROS_INFO_STREAM(path << ": removed, since no map was loaded from it for 30 days");
      }
    } catch (const Cancelled&) {  // whoever ends waits for this thread
    } catch (const std::exception& error) {
      tellNotKept(error);
    }
  }

  void tellNotKept(const std::exception& error) const {
    ROS_WARN_STREAM("map " << file_ << ": not kept for the next start, which takes as long as this one: "
                           << error.what() << " (~map_cache_folder)");
  }

  const std::string file_;
  const RouterCache cache_;
  std::shared_ptr<const Router> router_;
  const CancelSource stop_;
  std::thread writer_;
};

std::string keyOf(const RouterSource& source) {
  const MapOrigin& origin = source.origin;
  const MapParams& map = source.map;
  const RouterParams& router = source.router;
  return text(source.map_file, "|", static_cast<int>(origin.kind), "|", origin.point.x(), "|", origin.point.y(), "|",
              map.max_link_gap, "|", map.max_segment_length, "|", router.lane_change_price, "|",
              router.min_lane_change_length, "|", router.tight_lane_change_price, "|", router.min_turning_radius, "|",
              router.stopping_error);
}

}  // namespace

std::shared_ptr<const Router> sharedRouter(const RouterSource& source, const std::string& cache_folder) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<const Router>> known;
  const std::lock_guard<std::mutex> lock(mutex);
  auto& entry = known[keyOf(source)];
  auto router = entry.lock();
  if (router) return router;
  const auto loaded = std::make_shared<const LoadedRouter>(source, cache_folder);
  router = {loaded, loaded->router()};
  entry = router;
  return router;
}

}  // namespace external_command
