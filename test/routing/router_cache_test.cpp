// SPDX-License-Identifier: Apache-2.0
#include "external_command/routing/router_cache.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <future>
#include <iterator>
#include <random>

#include "../../src/core/block_file.h"
#include "external_command/core/error.h"
#include "external_command/core/text.h"
#include "support/map_matchers.h"

namespace external_command {
namespace {

namespace fs = std::filesystem;

constexpr unsigned kRoutePairSeed = 20261130;
const char* const kDemoMap = EC_SOURCE_DIR "/maps/demo_town/base_map.bin";

std::string bytesOf(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeBytes(const std::string& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::shared_ptr<const Router> routerOf(const RouterSource& source) {
  return std::make_shared<const Router>(readMap(source.map_file, source.origin, source.map), source.router);
}

/// The same routes, at the same cost, between random places.
testing::AssertionResult sameRoutes(const Router& a, const Router& b, int queries) {
  std::mt19937 random(kRoutePairSeed);
  std::vector<LaneIndex> lanes;
  for (LaneIndex i = 0; i < a.map().lanes().size(); ++i) {
    if (a.map().lane(i).isDrivable()) lanes.push_back(i);
  }
  const auto any_place = [&]() -> LanePoint {
    const LaneIndex lane = lanes[random() % lanes.size()];
    return {lane, std::uniform_real_distribution<double>(0.0, a.map().lane(lane).length())(random)};
  };
  const auto described = [](const Router& router, const RouteQuery& query) {
    try {
      const Route route = router.findRoute(query, CancelToken());
      std::string words = text(route.cost, " ", route.distance);
      for (const RouteStep& step : route.steps) words += text(" ", step.lane, ":", step.from_s, "-", step.to_s);
      return words;
    } catch (const NoRoute& error) {
      return std::string(error.what());
    }
  };
  for (int i = 0; i < queries; ++i) {
    const RouteQuery query{{any_place()}, {}, {any_place()}, {}};
    const std::string first = described(a, query), second = described(b, query);
    if (first != second) return testing::AssertionFailure() << "query " << i << ": " << first << " is not " << second;
  }
  return testing::AssertionSuccess();
}

class RouterCacheTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = testing::TempDir() + "router_cache_XXXXXX";
    ASSERT_NE(::mkdtemp(&folder_[0]), nullptr);
    source_.map_file = folder_ + "/base_map.bin";
    fs::copy_file(kDemoMap, source_.map_file);
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string cacheFolder() const { return folder_ + "/kept/maps"; }
  RouterCache cache() const { return RouterCache(cacheFolder(), source_); }
  void keep() const { cache().write(*routerOf(source_), CancelToken()); }

  void replaceByte(std::size_t at, char byte) const {
    std::fstream file(cache().path(), std::ios::binary | std::ios::in | std::ios::out);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte);
  }

  std::size_t filesInCacheFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(cacheFolder()), fs::directory_iterator()));
  }

  testing::AssertionResult isRefused(const std::string& why, bool is_damaged) const {
    const RouterCache::Answer answer = cache().read();
    if (answer.router) return testing::AssertionFailure() << "it was used";
    if (answer.is_damaged != is_damaged || answer.why_not.find(why) == std::string::npos) {
      return testing::AssertionFailure() << answer.is_damaged << ": " << answer.why_not;
    }
    return testing::AssertionSuccess();
  }

  std::string folder_;
  RouterSource source_;
};

TEST_F(RouterCacheTest, HasNothingAtFirst) {
  const RouterCache::Answer answer = cache().read();
  EXPECT_FALSE(answer.router);
  EXPECT_EQ(answer.why_not, "");
}

TEST_F(RouterCacheTest, GivesBackTheMapAndItsRoutes) {
  keep();
  const RouterCache::Answer answer = cache().read();
  ASSERT_TRUE(answer.router) << answer.why_not;
  EXPECT_TRUE(sameMap(answer.router->map(), *readMap(source_.map_file, {})));
  EXPECT_TRUE(sameRoutes(*answer.router, *routerOf(source_), 500));
  EXPECT_EQ(filesInCacheFolder(), 1u);
}

TEST_F(RouterCacheTest, GivesBackAMapWithAnOriginAndParametersOfItsOwn) {
  source_.origin.kind = MapOrigin::Kind::kAuto;
  source_.map.max_link_gap = 0.001;
  source_.router.lane_change_price = 0.0;
  source_.router.min_turning_radius = 8.0;
  keep();
  const RouterCache::Answer answer = cache().read();
  ASSERT_TRUE(answer.router) << answer.why_not;
  EXPECT_TRUE(sameMap(answer.router->map(), *readMap(source_.map_file, source_.origin, source_.map)));
  EXPECT_TRUE(sameRoutes(*answer.router, *routerOf(source_), 200));
}

TEST_F(RouterCacheTest, GivesBackRealMaps) {
  int found = 0;
  for (const char* name : {"autonomoustuff/base_map.bin", "town01/base_map.bin", "town10hd/sim_map.txt"}) {
    source_.map_file = std::string(EC_SHARED_DIR) + "/data/maps/" + name;
    if (!fs::exists(source_.map_file)) continue;
    SCOPED_TRACE(name);
    ++found;
    keep();
    const RouterCache::Answer answer = cache().read();
    ASSERT_TRUE(answer.router) << answer.why_not;
    EXPECT_TRUE(sameMap(answer.router->map(), *readMap(source_.map_file, {})));
    EXPECT_TRUE(sameRoutes(*answer.router, *routerOf(source_), 200));
  }
  if (found == 0) GTEST_SKIP() << "no maps in " << EC_SHARED_DIR << "/data/maps";
}

TEST_F(RouterCacheTest, IsNotUsedForAMapFileWithAnotherByte) {
  keep();
  const auto written = fs::last_write_time(source_.map_file);
  std::string bytes = bytesOf(source_.map_file);
  bytes.back() ^= 1;
  writeBytes(source_.map_file, bytes);
  fs::last_write_time(source_.map_file, written);
  EXPECT_TRUE(isRefused("the map file has changed", false));
  bytes.back() ^= 1;
  writeBytes(source_.map_file, bytes);
  EXPECT_TRUE(cache().read().router) << "the same bytes again, at another time";
}

TEST_F(RouterCacheTest, IsNotUsedWithOtherParameters) {
  keep();
  const RouterSource kept = source_;
  const auto refused_with = [&](const auto& change) {
    source_ = kept;
    change(&source_);
    return isRefused("other parameters", false);
  };
  EXPECT_TRUE(refused_with([](RouterSource* source) { source->origin.kind = MapOrigin::Kind::kAuto; }));
  EXPECT_TRUE(refused_with([](RouterSource* source) { source->origin = {MapOrigin::Kind::kGiven, {0.0, 1e-9}}; }));
  EXPECT_TRUE(refused_with([](RouterSource* source) { source->map.max_link_gap += 1e-9; }));
  EXPECT_TRUE(refused_with([](RouterSource* source) { source->map.max_segment_length -= 1.0; }));
  EXPECT_TRUE(refused_with([](RouterSource* source) { source->router.lane_change_price += 1.0; }));
}

TEST_F(RouterCacheTest, IsUsedWithOtherParametersThatDecideNothingOfIt) {
  keep();
  source_.router.stopping_error = 1.0;
  source_.router.min_lane_change_length = 25.0;
  source_.router.tight_lane_change_price = 5.0;
  source_.router.min_turning_radius = 9.0;
  const RouterCache::Answer answer = cache().read();
  ASSERT_TRUE(answer.router) << answer.why_not;
  EXPECT_EQ(answer.router->params().min_lane_change_length, 25.0);
  EXPECT_TRUE(sameRoutes(*answer.router, *routerOf(source_), 200));
}

TEST_F(RouterCacheTest, IsNotUsedByAnotherVersion) {
  fs::create_directories(cacheFolder());
  BlockWriter(cache().path(), CancelToken()).finish({"a program of the past", "", ""});
  EXPECT_TRUE(isRefused("another version of this program", false));
  BlockWriter(cache().path(), CancelToken()).finish({});
  EXPECT_TRUE(isRefused("another version of this program", false));
}

TEST_F(RouterCacheTest, IsNotUsedWithAnyBitFlipped) {
  keep();
  const std::string bytes = bytesOf(cache().path());
  std::mt19937 random(kRoutePairSeed);
  for (int i = 0; i < 300; ++i) {
    // A third of them near the end, where what is said of the rest is.
    const std::size_t place = random() % (i % 3 == 0 ? 3000 : bytes.size());
    const std::size_t at = bytes.size() - 1 - place;
    replaceByte(at, static_cast<char>(bytes[at] ^ 1 << random() % 8));
    ASSERT_TRUE(isRefused("damaged", true)) << place << " bytes before the end, with seed " << kRoutePairSeed;
    replaceByte(at, bytes[at]);
  }
  EXPECT_TRUE(cache().read().router) << "all bits are as they were";
  replaceByte(0, static_cast<char>(~bytes[0]));
  keep();
  EXPECT_TRUE(cache().read().router) << "written anew";
}

TEST_F(RouterCacheTest, IsNotUsedWithBytesTooFewOrTooMany) {
  keep();
  const std::string bytes = bytesOf(cache().path());
  std::mt19937 random(kRoutePairSeed);
  for (int i = 0; i < 200; ++i) {
    writeBytes(cache().path(), bytes.substr(0, i < 50 ? static_cast<std::size_t>(i) : random() % bytes.size()));
    ASSERT_TRUE(isRefused("damaged", true));
  }
  writeBytes(cache().path(), bytes + '\0');
  EXPECT_TRUE(isRefused("damaged", true));
  writeBytes(cache().path(), '\0' + bytes);
  EXPECT_TRUE(isRefused("damaged", true));
  writeBytes(cache().path(), bytesOf(source_.map_file));
  EXPECT_TRUE(isRefused("damaged", true)) << "another kind of file";
}

TEST_F(RouterCacheTest, IsNotUsedWhereItIsNoFile) {
  fs::create_directories(cacheFolder());
  ASSERT_EQ(::mkfifo(cache().path().c_str(), 0600), 0);
  EXPECT_TRUE(isRefused("no regular file", true)) << "nobody waits for who writes into a pipe";
  keep();
  EXPECT_TRUE(cache().read().router) << "it has taken the place of the pipe";
}

TEST_F(RouterCacheTest, LeavesAFolderInItsPlaceAlone) {
  fs::create_directories(cache().path() + "/something");
  EXPECT_TRUE(isRefused("no regular file", true));
  EXPECT_THROW(keep(), InternalError);
  EXPECT_TRUE(fs::exists(cache().path() + "/something"));
  EXPECT_EQ(filesInCacheFolder(), 1u) << "nothing is left beside it";
}

TEST_F(RouterCacheTest, SaysWhyItCannotBeWritten) {
  writeBytes(folder_ + "/kept", "a file where the folder should be");
  try {
    keep();
    FAIL() << "written";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("Not a directory"), std::string::npos) << error.what();
  }
}

TEST_F(RouterCacheTest, KeepsWhatWasThereWhenTheDiskIsFull) {
  keep();
  const auto router = routerOf(source_);
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  const rlimit little{100000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &little), 0);
  EXPECT_THROW(cache().write(*router, CancelToken()), InternalError);
  EXPECT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, handler);
  EXPECT_EQ(filesInCacheFolder(), 1u);
  EXPECT_TRUE(cache().read().router);
}

TEST_F(RouterCacheTest, LeavesNothingOfAWriteThatIsCancelled) {
  CancelSource stop;
  stop.cancel();
  EXPECT_THROW(cache().write(*routerOf(source_), stop.token()), Cancelled);
  EXPECT_EQ(filesInCacheFolder(), 0u);
}

TEST_F(RouterCacheTest, RemovesWhatKilledProcessesHaveLeft) {
  fs::create_directories(cacheFolder());
  const std::string left = cache().path() + ".999999999-1.new", of_another = cacheFolder() + "/a.cache.999999999-1.new",
                    in_use = cache().path() + "." + std::to_string(::getppid()) + "-1.new";
  for (const std::string& path : {left, of_another, in_use}) writeBytes(path, "x");
  keep();
  EXPECT_FALSE(fs::exists(left));
  EXPECT_TRUE(fs::exists(of_another));
  EXPECT_TRUE(fs::exists(in_use));
}

TEST_F(RouterCacheTest, RemovesWhatWasNotUsedForLong) {
  const auto long_ago = fs::file_time_type::clock::now() - RouterCache::kUnused - std::chrono::hours(1);
  keep();
  const std::string own = cache().path(), old = cacheFolder() + "/old-0123456789abcdef.cache",
                    used = cacheFolder() + "/used-0123456789abcdef.cache", begun = old + ".999999999-1.new",
                    others = cacheFolder() + "/others.cache", notes = cacheFolder() + "/notes.txt";
  for (const std::string& path : {old, used, begun, notes}) fs::copy_file(own, path);
  writeBytes(others, "of another program");
  for (const std::string& path : {own, old, begun, others, notes}) fs::last_write_time(path, long_ago);
  std::vector<std::string> removed = cache().removeUnused();
  std::sort(removed.begin(), removed.end());
  EXPECT_EQ(removed, (std::vector<std::string>{old, begun}));
  for (const std::string& path : {old, begun}) EXPECT_FALSE(fs::exists(path));
  for (const std::string& path : {own, used, others, notes}) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST_F(RouterCacheTest, IsUsedWhenItIsRead) {
  const auto now = fs::file_time_type::clock::now();
  keep();
  fs::last_write_time(cache().path(), now - 2 * RouterCache::kUnused);
  ASSERT_TRUE(cache().read().router);
  EXPECT_GT(fs::last_write_time(cache().path()), now - std::chrono::minutes(1));
  fs::last_write_time(cache().path(), now + std::chrono::hours(1));  // by a clock that was set back since
  ASSERT_TRUE(cache().read().router);
  EXPECT_GT(fs::last_write_time(cache().path()), now);
}

TEST_F(RouterCacheTest, LeavesRoomOnTheDisk) {
  const auto router = routerOf(source_);
  fs::resize_file(source_.map_file, std::uintmax_t{1} << 42);  // a hole of 4 TiB, of which no disk has room for two
  try {
    cache().write(*router, CancelToken());
    FAIL() << "written";
  } catch (const InternalError& error) {
    EXPECT_NE(std::string(error.what()).find("8388608 MiB have to be"), std::string::npos) << error.what();
  }
  EXPECT_EQ(filesInCacheFolder(), 0u);
}

TEST_F(RouterCacheTest, IsWrittenAndReadByManyAtOnce) {
  const auto router = routerOf(source_);
  std::vector<std::future<bool>> all;
  for (int i = 0; i < 4; ++i) {
    all.push_back(std::async(std::launch::async, [&] {
      for (int round = 0; round < 5; ++round) {
        cache().write(*router, CancelToken());
        if (!cache().read().router) return false;
      }
      return true;
    }));
  }
  for (std::future<bool>& each : all) EXPECT_TRUE(each.get());
  EXPECT_EQ(filesInCacheFolder(), 1u);
}

TEST_F(RouterCacheTest, HasOneFileForEachMapFile) {
  const RouterCache own = cache();
  EXPECT_EQ(RouterCache(cacheFolder(), {folder_ + "/./base_map.bin", {}, {}, {}}).path(), own.path());
  fs::create_symlink(folder_, folder_ + "/link");
  EXPECT_EQ(RouterCache(cacheFolder(), {folder_ + "/link/base_map.bin", {}, {}, {}}).path(), own.path());
  EXPECT_NE(RouterCache(cacheFolder(), {kDemoMap, {}, {}, {}}).path(), own.path()) << "of the same name elsewhere";
  EXPECT_EQ(fs::path(own.path()).filename().string().rfind("base_map-", 0), 0u) << own.path();
}

TEST_F(RouterCacheTest, IsForLargeMapsThatAreDrivenOn) {
  EXPECT_FALSE(cache().isWorthwhile());
  fs::resize_file(source_.map_file, RouterCache::kLeastMapSize);
  EXPECT_TRUE(cache().isWorthwhile());
  source_.map.keep_findings = true;
  EXPECT_FALSE(cache().isWorthwhile());
  source_ = {folder_ + "/no_such_map.bin", {}, {}, {}};
  EXPECT_FALSE(cache().isWorthwhile());
}

}  // namespace
}  // namespace external_command
