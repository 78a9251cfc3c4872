#include <gtest/gtest.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <random>
#include <thread>
#include <utility>

#include "tasks/io/file.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/store.hpp"
#include "tests/tasks/run/crash.hpp"
#include "tests/tasks/run/first_table.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::isojam;
using test::shell;
using test::TemporaryDirectory;

using test::Crash;
using test::crash_manifest;
using test::stop_at_checkpoints;

/// Enters a namespace in which this process and its children can mount file systems that no other process sees. Returns
/// false if this is not allowed.
bool enter_namespace() {
  const auto user = std::to_string(geteuid()), group = std::to_string(getegid());
  if (unshare(CLONE_NEWUSER | CLONE_NEWNS) != 0) return false;
  const auto as_outside = [](const std::string& id) { return id + " " + id + " 1"; };
  try {
    test::write_text("/proc/self/setgroups", "deny");
    test::write_text("/proc/self/uid_map", as_outside(user));
    test::write_text("/proc/self/gid_map", as_outside(group));
  } catch (const std::exception&) {
    return false;
  }
  return true;
}

/// A small file system for results. This is a separate suite because it needs the permission to mount; without it, only
/// these tests are skipped.
class CrashOnAMount : public Crash {
 protected:
  void SetUp() override {
    ASSERT_NO_FATAL_FAILURE(Crash::SetUp());
    fs::create_directory(disk_);
    const auto mounted = [&] { return mount("tmpfs", disk_.c_str(), "tmpfs", 0, "size=160k") == 0; };
    mounted_ = mounted() || (errno == EPERM && enter_namespace() && mounted());
    if (mounted_) return;
    const std::error_code why(errno, std::generic_category());
    std::fprintf(stderr, "SKIPPED, not tested: a small file system cannot be mounted here (%s)\n",
                 why.message().c_str());
    GTEST_SKIP() << "a small file system cannot be mounted here: " << why.message();
  }
  void TearDown() override {
    if (mounted_) {
      EXPECT_EQ(umount(disk_.c_str()), 0);
    }
  }
  /// Changes the size of the file system, or whether it is writable.
  void remount(unsigned long flags, const char* size) const {
    ASSERT_EQ(mount("tmpfs", disk_.c_str(), "tmpfs", MS_REMOUNT | flags, size), 0);
  }

  const fs::path disk_ = here_ / "results";
  bool mounted_ = false;
};

/// Checks that every file that could be used as a result is complete.
void expect_whole(const fs::path& results) {
  for (const std::string folder : {"records", "packings", "paths", "checkpoints"}) {
    for (const auto& name : names_in(results / folder))
      EXPECT_NO_THROW(read_sealed((results / folder / (name + ".json")).string())) << folder << "/" << name;
  }
}

/// Time of the last change of each checkpoint and record.
std::map<std::string, fs::file_time_type> write_times(const fs::path& results) {
  std::map<std::string, fs::file_time_type> times;
  for (const std::string folder : {"checkpoints", "records"}) {
    for (const auto& name : names_in(results / folder)) {
      std::error_code gone;
      const auto time = fs::last_write_time(results / folder / (name + ".json"), gone);
      if (!gone) times[folder + name] = time;
    }
  }
  return times;
}

bool is_running(int child) {
  siginfo_t info{};
  return waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid == 0;
}

TEST_F(Crash, KilledTwentyTimesItGivesTheSameBytes) {
  std::mt19937_64 random(11);
  int kills = 0, rounds = 0, continued = 0;
  while (kills < 20) {
    fs::remove_all(here_ / "results");
    ++rounds;
    for (;;) {
      auto writes = random() % 40;
      const std::chrono::microseconds moment(random() % 20000);
      auto seen = write_times(here_ / "results");
      const bool has_checkpoint = !names_in(here_ / "results" / "checkpoints").empty();
      const auto ended = run([&](int process) {
        while (writes > 0 && is_running(process)) {
          for (const auto& [name, time] : write_times(here_ / "results")) {
            if (std::exchange(seen[name], time) != time && writes > 0) --writes;
          }
          std::this_thread::sleep_for(1ms);
        }
        std::this_thread::sleep_for(moment);
        kill(process, SIGKILL);
      });
      continued += has_checkpoint;
      if (ended.exit_code == 0) break;
      ASSERT_EQ(ended.exit_code, -1) << ended.err;
      ++kills;
      if (fs::exists(here_ / "results")) expect_whole(here_ / "results");
    }
    EXPECT_EQ(results(), reference());
  }
  std::printf("%d kills, %d complete sweeps, %d times a checkpoint was there to go on from\n", kills, rounds,
              continued);
  EXPECT_GT(continued, 5);
}

TEST_F(Crash, AChangedByteIsDetectedAndRecomputed) {
  copy_reference();
  const auto before = test::files_below(here_ / "results");
  const std::vector<std::string> damaged{"records/dodecahedron-N24-r0001.json", "packings/dodecahedron-N28-r0000.json",
                                         "paths/dodecahedron-N40-r0001.json"};
  for (const auto& name : damaged) {
    auto text = before.at(name);
    text[text.size() / 2] = static_cast<char>(text[text.size() / 2] ^ 1);
    test::write_text(here_ / "results" / name, text);
  }
  const auto again = run();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  for (const auto& name : damaged) EXPECT_NE(again.err.find(name + ": /checksum"), std::string::npos) << again.err;
  EXPECT_EQ(results(), reference());
  const auto after = test::files_below(here_ / "results");
  for (const auto& [name, content] : before) {
    const bool redone =
        std::any_of(damaged.begin(), damaged.end(),
                    [stem = fs::path(name).stem()](const std::string& d) { return fs::path(d).stem() == stem; });
    if (!redone) {
      EXPECT_EQ(after.at(name), content) << name << " was touched";
    }
  }
}

TEST_F(Crash, ARunResumesFromItsCheckpoints) {
  run([&](int process) { stop_at_checkpoints(here_ / "results", 1, process, SIGKILL); });
  const auto names = names_in(here_ / "results" / "checkpoints");
  ASSERT_FALSE(names.empty());
  // Without the checkpoint, the bytes would be the same. Only the checkpoint contains the hour of earlier CPU time.
  const auto path = here_ / "results" / "checkpoints" / (names[0] + ".json");
  auto checkpoint = read_sealed(path.string());
  checkpoint.erase("checksum");
  checkpoint.at("timing").at("cpu_seconds") = 3600.0;
  test::write_text(path, sealed(checkpoint));
  EXPECT_EQ(run().exit_code, 0);
  const auto record = read_sealed((here_ / "results" / "records" / (names[0] + ".json")).string());
  EXPECT_GE(record.at("timing").at("cpu_seconds").get<double>(), 3600);
  EXPECT_EQ(results(), reference());
}

TEST_F(Crash, ADamagedCheckpointRestartsItsReplicate) {
  run([&](int process) { stop_at_checkpoints(here_ / "results", 1, process, SIGKILL); });
  const auto names = names_in(here_ / "results" / "checkpoints");
  ASSERT_FALSE(names.empty());
  const auto path = here_ / "results" / "checkpoints" / (names[0] + ".json");
  auto text = read_text(path.string());
  test::write_text(path, text.substr(0, text.size() - text.size() / 3));
  const auto again = run();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_NE(again.err.find("starts from the beginning"), std::string::npos) << again.err;
  EXPECT_EQ(results(), reference());
}

TEST_F(Crash, ACheckpointWithARecordIsRemoved) {
  copy_reference();
  // One checkpoint is left as by a kill after the record was written. The other one has no record.
  const auto checkpoints = here_ / "results" / "checkpoints";
  test::write_text(checkpoints / "dodecahedron-N28-r0001.json", "{}");
  test::write_text(checkpoints / "another.json", "{}");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(names_in(checkpoints), std::vector<std::string>{"another"});
  fs::remove(checkpoints / "another.json");
  EXPECT_EQ(results(), reference());
}

TEST_F(Crash, AFileSizeLimitEndsARun) {
  const auto ended = shell("ulimit -f 12; $ISOJAM run m.json -o results", here_.path());  // in blocks of 512 bytes
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
  EXPECT_NE(ended.err.find("repeat the command to resume"), std::string::npos) << ended.err;
  expect_whole(here_ / "results");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(results(), reference());
}

TEST_F(CrashOnAMount, AFullDiskEndsARun) {
  const auto ended = run();
  EXPECT_EQ(ended.exit_code, 1) << ended.err;
  EXPECT_NE(ended.err.find("No space left"), std::string::npos) << ended.err;
  expect_whole(disk_);
  remount(0, "size=20m");
  const auto again = run();
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(results(), reference());
}

TEST_F(CrashOnAMount, AReadOnlyDirectoryIsRejected) {
  remount(0, "size=20m");
  run([&](int process) { stop_at_checkpoints(disk_, 1, process, SIGKILL); });
  remount(MS_RDONLY, "");
  const auto before = test::files_below(disk_);
  const auto refused = run();
  EXPECT_EQ(refused.exit_code, 1) << refused.err;
  EXPECT_NE(refused.err.find("cannot be written to"), std::string::npos) << refused.err;
  EXPECT_EQ(test::files_below(disk_), before);
  remount(0, "");
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(results(), reference());
}

TEST_F(Crash, SimultaneousShardsMakeTheWholeStudy) {
  std::vector<std::thread> shards;
  std::vector<test::Finished> finished(3);
  for (int k = 0; k < 3; ++k) {
    shards.emplace_back([&, k] {
      finished[static_cast<std::size_t>(k)] =
          isojam({"run", "m.json", "-o", "results", "--shard", std::to_string(k + 1) + "/3"}, here_.path());
    });
  }
  for (auto& shard : shards) shard.join();
  for (const auto& shard : finished) {
    EXPECT_EQ(shard.exit_code, 0) << shard.err;
    EXPECT_EQ(shard.out, "") << "the table is for when all are finished";
  }
  EXPECT_FALSE(fs::exists(here_ / "results" / "tables.json"));
  const auto table = isojam({"aggregate", "results", "-o", "results/tables.json"}, here_.path());
  EXPECT_EQ(test::first_table(table.out), test::first_table(finished_.out));
  EXPECT_EQ(results(), reference());
}

TEST_F(Crash, SigintEndsARunInALargeStep) {
  auto manifest = crash_manifest();
  manifest["sweep"]["particles"] = {600};
  manifest["protocol"] = {{"initial_density", 0.3}};
  test::write_text(here_ / "m.json", manifest.dump());
  const auto steps = [&] {
    const auto path = here_ / "results" / "checkpoints" / (names_in(here_ / "results" / "checkpoints").at(0) + ".json");
    return read_sealed(path.string()).at("path").size();
  };
  std::size_t before = 0;
  const auto stopped = run([&](int process) {
    stop_at_checkpoints(here_ / "results", 1, 0, 0);
    before = steps();
    kill(process, SIGINT);
  });
  EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
  EXPECT_LE(steps(), before + 1) << "it went on to the end of a step";
}

TEST_F(Crash, ASymbolicLinkForAFolderIsRejected) {
  const TemporaryDirectory elsewhere;
  for (const std::string folder : {"records", "packings", "paths", "checkpoints"}) {
    fs::remove_all(here_ / "results");
    fs::create_directory(here_ / "results");
    fs::create_directory_symlink(elsewhere.path(), here_ / "results" / folder);
    const auto refused = run();
    EXPECT_EQ(refused.exit_code, 1) << folder << ": " << refused.err;
    EXPECT_NE(refused.err.find("symbolic link"), std::string::npos) << refused.err;
    EXPECT_TRUE(fs::is_empty(elsewhere.path())) << folder;
  }
  // A link in place of a result is replaced; its target does not change.
  const auto target = elsewhere / "target.json";
  fs::remove_all(here_ / "results");
  copy_reference();
  test::write_text(target, "untouched");
  const auto record = here_ / "results" / "records" / "dodecahedron-N24-r0000.json";
  fs::remove(record);
  fs::create_symlink(target, record);
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(read_text(target.string()), "untouched");
  EXPECT_FALSE(fs::is_symlink(record));
  EXPECT_EQ(results(), reference());
}

}  // namespace
}  // namespace isojam
