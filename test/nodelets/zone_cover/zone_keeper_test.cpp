// SPDX-License-Identifier: Apache-2.0
#include "nodelets/zone_cover/zone_keeper.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/mount.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>

#include "support/comes_true.h"
#include "support/zone_plans.h"

namespace {

std::atomic<int> sync_takes{0};  // [ms]

}  // namespace

/// Stands before that of the C library: a disk that takes its time.
extern "C" int fsync(int fd) {
  std::this_thread::sleep_for(std::chrono::milliseconds(sync_takes));
  return static_cast<int>(syscall(SYS_fsync, fd));
}

namespace external_command {
namespace {

namespace fs = std::filesystem;

class ZoneKeeperTest : public testing::Test {
 protected:
  ZoneKeeperTest() { fs::create_directories(folder_); }
  ~ZoneKeeperTest() override {
    sync_takes = 0;
    fs::remove_all(folder_);
  }

  ZonePlanFile file(const std::string& label = "yard") const {
    const CoverageArea area{Polygon({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, "yard"), {}};
    return {folder_, zoneKey("/courtyard", label, area, {}, {})};
  }

  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  const std::string folder_ = "/tmp/external_command_zone_keeper_test_" + std::to_string(getpid());
};

TEST_F(ZoneKeeperTest, KeepsAPlanThatIsAdopted) {
  ZoneKeeper keeper;
  const auto draft = keeper.draft(file(), begunPlan());
  EXPECT_EQ(draft->failure(), "");
  EXPECT_FALSE(fs::exists(file().path())) << "the command may yet be refused";
  keeper.adopt(*draft);
  EXPECT_FALSE(keeper.unwritten(file().path()));
  EXPECT_TRUE(areEqual(*file().read(), begunPlan()));
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(ZoneKeeperTest, LeavesThePlanBeforeWhereTheNextOneIsNotSent) {
  ZoneKeeper keeper;
  keeper.adopt(*keeper.draft(file(), begunPlan()));
  keeper.draft(file(), lapAndSwaths());
  EXPECT_TRUE(comesTrue([&] { return filesInFolder() == 1; })) << "the temporary file is removed";
  EXPECT_FALSE(keeper.unwritten(file().path()));
  EXPECT_TRUE(areEqual(*file().read(), begunPlan()));
}

TEST_F(ZoneKeeperTest, KeepsWhatIsSweptAndThatAtOnceAtTheEnd) {
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  keeper.adopt(*keeper.draft(file(), progress));
  for (int i = 1; i <= 20; ++i) {
    progress.sweep(0, i);
    keeper.note(file().path(), progress, false);
    keeper.tick();
  }
  keeper.finish(file().path());
  EXPECT_TRUE(comesTrue([&] {
    const auto read = file().read();
    return read && read->sweptOf(0) == 20.0;
  }));
}

TEST_F(ZoneKeeperTest, WritesWhatIsLeftWhenItGoes) {
  CoverageProgress progress = lapAndSwaths();
  {
    ZoneKeeper keeper;
    keeper.adopt(*keeper.draft(file(), progress));
    progress.sweep(1, 4.0);
    keeper.note(file().path(), progress, false);
  }
  EXPECT_TRUE(areEqual(*file().read(), progress));
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(ZoneKeeperTest, WritesNoMoreOftenThanOnceASecond) {
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  keeper.adopt(*keeper.draft(file(), progress));
  const auto begin = std::chrono::steady_clock::now();
  int writes = 0;
  for (ino_t last = 0; std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(1500);) {
    progress.sweep(0, progress.sweptOf(0) + 0.01);
    keeper.note(file().path(), progress, false);
    keeper.tick();
    struct stat status {};
    if (stat(file().path().c_str(), &status) == 0 && status.st_ino != last) {
      last = status.st_ino;
      ++writes;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  EXPECT_LE(writes, 3);
}

TEST_F(ZoneKeeperTest, DoesNotWaitForItsTimeWhereALineIsDone) {
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  keeper.adopt(*keeper.draft(file(), progress));
  for (int i = 1; i < 20; ++i) {
    progress.sweep(0, i);
    keeper.note(file().path(), progress, true);
    ASSERT_TRUE(comesTrue([&] {
      keeper.tick();
      return file().read() && file().read()->sweptOf(0) == i;
    }));
  }
}

TEST_F(ZoneKeeperTest, DoesNotKeepASlowDiskBusyWhileThereIsNews) {
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  keeper.adopt(*keeper.draft(file(), progress));
  EXPECT_FALSE(keeper.unwritten(file().path()));
  sync_takes = 100;
  std::size_t writing = 0, looks = 0;
  for (int i = 1; i <= 300; ++i, ++looks) {
    progress.sweep(0, 0.1 * i);
    keeper.note(file().path(), progress, true);
    keeper.tick();
    writing += filesInFolder() > 1;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_LT(writing, looks / 4);
}

TEST_F(ZoneKeeperTest, WritesWhatIsLeftASecondAfterTheLastNewsHoweverSlowTheDisk) {
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  keeper.adopt(*keeper.draft(file(), progress));
  EXPECT_FALSE(keeper.unwritten(file().path()));
  sync_takes = 400;
  progress.sweep(0, 5.0);
  keeper.note(file().path(), progress, true);
  keeper.tick();
  progress.sweep(0, 6.0);
  keeper.note(file().path(), progress, true);
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_TRUE(comesTrue([&] {
    keeper.tick();
    return file().read()->sweptOf(0) == 6.0;
  }));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(8))
      << "a twentieth of the time would be 16 s for the write before";
}

/// Opening a pipe to write waits for someone who reads: a disk that does not answer.
TEST_F(ZoneKeeperTest, IsDelayedBySlowDisksForASecondAtMost) {
  const std::string last = file().temporaryPath();
  const std::size_t number = last.rfind('-') + 1;
  const int next = std::stoi(last.substr(number)) + 1;
  const std::string pipe = last.substr(0, number) + std::to_string(next) + ".new";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  const auto begin = std::chrono::steady_clock::now();
  const auto draft = keeper.draft(file(), progress);
  EXPECT_NE(draft->failure().find("has not answered"), std::string::npos) << draft->failure();
  keeper.adopt(*draft);
  progress.sweep(0, 10.0);
  keeper.note(file().path(), progress, true);
  keeper.tick();
  EXPECT_TRUE(areEqual(*keeper.unwritten(file().path()), progress));
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(3));
  std::ifstream answer(pipe);
  EXPECT_TRUE(comesTrue([&] {
    keeper.tick();
    return keeper.failureOf(file().path()).empty() && !keeper.unwritten(file().path());
  })) << "a pipe cannot be synchronized; the next write can";
  EXPECT_TRUE(areEqual(*file().read(), progress));
}

TEST_F(ZoneKeeperTest, GoesOnWithoutAFolderAndRemembers) {
  std::ofstream(folder_ + "/file") << "stands where the folder should be";
  const CoverageArea area{Polygon({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, "yard"), {}};
  const ZonePlanFile nowhere(folder_ + "/file", zoneKey("/courtyard", "yard", area, {}, {}));
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  const auto draft = keeper.draft(nowhere, progress);
  EXPECT_NE(draft->failure().find("Not a directory"), std::string::npos) << draft->failure();
  keeper.adopt(*draft);
  EXPECT_TRUE(comesTrue([&] { return !keeper.failureOf(nowhere.path()).empty(); }));
  progress.sweep(0, 12.0);
  keeper.note(nowhere.path(), progress, false);
  const auto kept = keeper.unwritten(nowhere.path());
  ASSERT_TRUE(kept);
  EXPECT_TRUE(areEqual(*kept, progress));
}

TEST_F(ZoneKeeperTest, ForgetsWhereTheDiskNeverComesBack) {
  std::ofstream(folder_ + "/file") << "x";
  const CoverageArea area{Polygon({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, "yard"), {}};
  ZoneKeeper keeper;
  std::size_t known = 0;
  for (const std::string label : {"1", "2", "3", "4", "5", "6", "7", "8"}) {
    const ZonePlanFile nowhere(folder_ + "/file", zoneKey("/courtyard", label, area, {}, {}));
    keeper.adopt(*keeper.draft(nowhere, lapAndSwaths()));
    EXPECT_TRUE(comesTrue([&] { return !keeper.failureOf(nowhere.path()).empty(); }));
    keeper.finish(nowhere.path());
  }
  for (const std::string label : {"1", "2", "3", "4", "5", "6", "7", "8"}) {
    const ZonePlanFile nowhere(folder_ + "/file", zoneKey("/courtyard", label, area, {}, {}));
    known += keeper.unwritten(nowhere.path()).has_value();
  }
  EXPECT_LE(known, 5u);
  EXPECT_GE(known, 4u);
}

/// Files can be no longer than that, in this process, while it lives.
class SmallDisk {
 public:
  explicit SmallDisk(rlim_t bytes) : handler_(signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~SmallDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    signal(SIGXFSZ, handler_);
  }

 private:
  void (*handler_)(int);
  rlimit before_{};
};

TEST_F(ZoneKeeperTest, LeavesTheFileWholeWhereTheDiskIsFullAndTriesAgain) {
  ZoneKeeper keeper;
  CoverageProgress progress = lapAndSwaths();
  keeper.adopt(*keeper.draft(file(), progress));
  EXPECT_FALSE(keeper.unwritten(file().path()));
  progress.sweep(0, 33.0);
  {
    const SmallDisk full(100);
    keeper.note(file().path(), progress, false);
    EXPECT_TRUE(comesTrue([&] {
      keeper.tick();
      return !keeper.failureOf(file().path()).empty();
    }));
    EXPECT_TRUE(areEqual(*file().read(), lapAndSwaths())) << "the old file, whole";
    EXPECT_EQ(filesInFolder(), 1u);
  }
  EXPECT_TRUE(comesTrue([&] {
    keeper.tick();
    return keeper.failureOf(file().path()).empty();
  }));
  EXPECT_TRUE(areEqual(*file().read(), progress));
}

TEST_F(ZoneKeeperTest, ToldByAFullFileSystem) {
  const std::string disk = folder_ + "/disk";
  fs::create_directories(disk);
  if (mount("tmpfs", disk.c_str(), "tmpfs", 0, "size=4k") != 0) GTEST_SKIP() << "may not mount";
  std::ofstream(disk + "/ballast") << std::string(100000, 'x');
  {
    ZoneKeeper keeper;
    const CoverageArea area{Polygon({{0, 0}, {40, 0}, {40, 30}, {0, 30}}, "yard"), {}};
    const auto draft = keeper.draft({disk, zoneKey("/courtyard", "yard", area, {}, {})}, lapAndSwaths());
    EXPECT_NE(draft->failure().find("No space left"), std::string::npos) << draft->failure();
  }
  umount(disk.c_str());
}

}  // namespace
}  // namespace external_command
