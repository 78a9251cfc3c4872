#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "tasks/io/sealed.hpp"
#include "tests/tasks/run/crash.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::Crash;
using test::crash_manifest;
using test::isojam;
using test::stop_at_checkpoints;

TEST_F(Crash, StatusReportsUnfinishedReplicates) {
  run([&](int process) { stop_at_checkpoints(here_ / "results", 2, process, SIGKILL); });
  const auto under_way = isojam({"status", "results"}, here_.path());
  EXPECT_EQ(under_way.exit_code, 0) << under_way.err;
  EXPECT_NE(under_way.out.find("of 6 replicates recorded"), std::string::npos) << under_way.out;
  for (const auto& name : names_in(here_ / "results" / "checkpoints")) {
    if (!fs::exists(here_ / "results" / "records" / (name + ".json"))) {
      EXPECT_NE(under_way.out.find(name + ": "), std::string::npos) << under_way.out;
    }
  }
  // The process was killed, so no process works on this replicate, although its last step was recent.
  EXPECT_NE(under_way.out.find(", 0 running, "), std::string::npos) << under_way.out;
  EXPECT_NE(under_way.out.find(" interrupted\n"), std::string::npos) << under_way.out;
  // A fast processor needs "less than 1 s", a slow one "about 2 s".
  EXPECT_NE(under_way.out.find("no process works in this directory; the missing replicates need "), std::string::npos)
      << under_way.out;
  EXPECT_EQ(isojam({"run", "m.json", "-o", "results"}, here_.path(),
                   [&](int) {
                     stop_at_checkpoints(here_ / "results", 1, 0, 0);
                     for (int k = 0; k < 40; ++k) {
                       const auto moving = isojam({"status", "results"}, here_.path());
                       EXPECT_EQ(moving.exit_code, 0) << moving.err;
                       EXPECT_EQ(moving.out.find("problem: "), std::string::npos) << moving.out;
                     }
                   })
                .exit_code,
            0);
  const auto done = isojam({"status", (*shared_ / "results").string()}, here_.path());
  EXPECT_EQ(done.out.rfind("tiny: 6 of 6 replicates recorded, 0 failed, ", 0), 0U) << done.out;
  EXPECT_EQ(isojam({"status", "absent"}, here_.path()).exit_code, 2);
}

TEST_F(Crash, StatusEstimatesNoTimeAfterTheEndOfTheStoppingRule) {
  auto json = crash_manifest();
  json["replicates"] = {{"min", 2}, {"max", 3}, {"quantity", "phi_j"}, {"half_width", 1e-5}};
  json["protocol"]["max_steps"] = 2;
  test::write_text(here_ / "ends.json", json.dump());
  // All replicates fail, so no point gets more than two.
  ASSERT_EQ(isojam({"run", "ends.json", "-o", "ends"}, here_.path()).exit_code, 1);
  const auto ended = isojam({"status", "ends"}, here_.path());
  EXPECT_EQ(ended.out.rfind("tiny: 6 of up to 9 replicates recorded, 6 failed, ", 0), 0U) << ended.out;
  EXPECT_EQ(ended.out.find("CPU time"), std::string::npos) << ended.out;
  fs::remove(here_ / "ends/records" / (names_in(here_ / "ends/records").at(0) + ".json"));
  const auto missing = isojam({"status", "ends"}, here_.path());
  EXPECT_NE(missing.out.find("the missing replicates need at most "), std::string::npos) << missing.out;
  // Of two packings, the interval is too wide, so a third one is needed.
  json["protocol"].erase("max_steps"), json["sweep"]["solid"] = {"dodecahedron"}, json["replicates"]["quantity"] = "Z";
  test::write_text(here_ / "goes_on.json", json.dump());
  ASSERT_EQ(isojam({"run", "goes_on.json", "-o", "goes_on"}, here_.path()).exit_code, 0);
  fs::remove(here_ / "goes_on/records/dodecahedron-N24-r0002.json");
  EXPECT_NE(isojam({"status", "goes_on"}, here_.path()).out.find("need at most "), std::string::npos);
}

TEST_F(Crash, MissingResultsAreNoUsageError) {
  const std::string name = "dodecahedron-N24-r0000";
  const auto export_as = [&](const std::string& format) {
    return std::vector<std::string>{"export", "results", name, "--format", format, "-o", "x"};
  };
  auto path = export_as("gsd");
  path.emplace_back("--path");
  struct Case {
    std::string removed;
    std::vector<std::vector<std::string>> commands;
  };
  const std::vector<Case> cases{
      {"packings/" + name + ".json", {export_as("gsd"), export_as("contacts")}},
      {"paths/" + name + ".json", {path}},
      {"manifest.json", {{"status", "results"}, {"rerun", "results", name}, {"measure", "results"}}}};
  for (const auto& [removed, commands] : cases) {
    fs::remove_all(here_ / "results");
    copy_reference();
    fs::remove(here_ / "results" / removed);
    for (const auto& command : commands) {
      const auto ended = isojam(command, here_.path());
      EXPECT_EQ(ended.exit_code, 65) << removed << ": " << command[0] << ": " << ended.err;
      EXPECT_NE(ended.err.find("results/" + removed + ": "), std::string::npos) << ended.err;
    }
  }
  // The record is listed, but its content is not there.
  fs::remove_all(here_ / "results");
  copy_reference();
  fs::remove(here_ / "results/records" / (name + ".json"));
  fs::create_symlink("nowhere", here_ / "results/records" / (name + ".json"));
  for (const std::vector<std::string>& command :
       {std::vector<std::string>{"aggregate", "results"}, {"report", "results"}, export_as("gsd")}) {
    const auto ended = isojam(command, here_.path());
    EXPECT_EQ(ended.exit_code, 65) << command[0] << ": " << ended.err;
    EXPECT_NE(ended.err.find(name + ".json: the file is missing"), std::string::npos) << ended.err;
  }
  EXPECT_EQ(run().exit_code, 0);
  EXPECT_EQ(results(), reference());
}

TEST_F(Crash, FilesThatDisappearAreNoticed) {
  for (const std::string folder : {"records", "packings", "paths"}) {
    const auto remove_one = [&](int) {
      for (int i = 0; i < 200000 && names_in(here_ / "results" / "records").empty(); ++i)
        std::this_thread::sleep_for(500us);
      const auto name = names_in(here_ / "results" / "records").at(0);
      fs::remove(here_ / "results" / folder / (name + ".json"));
    };
    fs::remove_all(here_ / "results");
    const auto shard = isojam({"run", "m.json", "-o", "results", "--shard", "1/2"}, here_.path(), remove_one);
    EXPECT_EQ(shard.exit_code, 1) << folder << ": " << shard.err;
    EXPECT_NE(shard.err.find("another process removed or changed files of 1 replicate"), std::string::npos)
        << shard.err;
    fs::remove_all(here_ / "results");
    const auto incomplete = run(remove_one);
    EXPECT_EQ(incomplete.exit_code, 1) << folder << ": " << incomplete.err;
    EXPECT_NE(incomplete.err.find("another process removed or changed files of "), std::string::npos) << incomplete.err;
    EXPECT_EQ(incomplete.out, "") << "no table of what is left";
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_EQ(results(), reference());
  }
}

TEST_F(Crash, AShardPrintsTheNextCommandForAShell) {
  const auto shard = isojam({"run", "m.json", "-o", "my dir", "--shard", "1/6"}, here_.path());
  EXPECT_EQ(shard.exit_code, 0) << shard.err;
  EXPECT_NE(shard.err.find("\"isojam aggregate 'my dir' -o 'my dir/tables.json'\""), std::string::npos) << shard.err;
}

TEST_F(Crash, TheTableBelongsToTheManifestThatWasRun) {
  const auto manifest = [&](int seed) {
    auto json = crash_manifest();
    json["seed"] = seed;
    return json.dump();
  };
  test::write_text(here_ / "other.json", manifest(8));
  ASSERT_EQ(isojam({"run", "other.json", "-o", "other"}, here_.path()).exit_code, 0);
  // The manifest and a record of another study appear while records are made.
  const auto foreign = run([&](int) {
    for (int i = 0; i < 200000 && names_in(here_ / "results" / "records").empty(); ++i)
      std::this_thread::sleep_for(500us);
    const auto name = "records/" + names_in(here_ / "results" / "records").at(0) + ".json";
    fs::copy_file(here_ / "other" / name, here_ / "results" / name, fs::copy_options::overwrite_existing);
    fs::copy_file(here_ / "other/manifest.json", here_ / "results/manifest.json", fs::copy_options::overwrite_existing);
  });
  EXPECT_EQ(foreign.exit_code, 1) << foreign.err;
  EXPECT_NE(foreign.err.find("only an earlier manifest requests the settings of "), std::string::npos) << foreign.err;
  EXPECT_NE(foreign.err.find("another process removed or changed files of "), std::string::npos) << foreign.err;
}

TEST_F(Crash, AllCommandsReportForeignRecords) {
  copy_reference();
  auto json = crash_manifest();
  json["seed"] = 8;
  test::write_text(here_ / "other.json", json.dump());
  ASSERT_EQ(isojam({"run", "other.json", "-o", "other"}, here_.path()).exit_code, 0);
  const auto name = names_in(here_ / "other/records").at(0);
  for (const std::string folder : {"records/", "packings/", "paths/"}) {
    const auto file = folder + name + ".json";
    fs::copy_file(here_ / "other" / file, here_ / "results" / file, fs::copy_options::overwrite_existing);
  }
  const auto status = isojam({"status", "results"}, here_.path());
  EXPECT_NE(status.out.find("5 of 6 replicates recorded"), std::string::npos) << status.out;
  EXPECT_NE(status.out.find("  1 record is requested by no manifest, for example " + name), std::string::npos)
      << status.out;
  EXPECT_EQ(isojam({"run", "m.json", "-o", "results", "--dry-run"}, here_.path()).exit_code, 0);
  const auto without = run();
  EXPECT_EQ(without.exit_code, 1);
  EXPECT_NE(without.err.find(name + ".json: /provenance/seed: 8 in the record, 7 in this manifest"), std::string::npos)
      << without.err;
  EXPECT_EQ(isojam({"export", "results", name, "--format", "gsd", "-o", "x.gsd"}, here_.path()).exit_code, 65);
  EXPECT_FALSE(fs::exists(here_ / "x.gsd"));
  for (const std::string command : {"aggregate", "report"}) {
    const auto made = isojam({command, "results"}, here_.path());
    EXPECT_NE(made.err.find("no manifest requests the settings of 1 of the records, for example " + name),
              std::string::npos)
        << command << ": " << made.err;
  }
}

TEST_F(Crash, RerunReportsARecordThatCannotBeRead) {
  copy_reference();
  const std::string name = "dodecahedron-N28-r0001";
  const auto record = here_ / "results" / "records" / (name + ".json");
  test::write_text(record, "{}");
  const auto ended = isojam({"rerun", "results", name}, here_.path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.out, name + ": there was no valid record to compare the result with\n");
  EXPECT_EQ(results(), reference());
  // A file cannot replace a folder, and a folder cannot be read as a file.
  fs::remove(record);
  fs::create_directories(record / "inside");
  EXPECT_EQ(isojam({"rerun", "results", name}, here_.path()).exit_code, 1);
}

TEST_F(Crash, RerunFindsTheSameBits) {
  copy_reference();
  const std::string name = "dodecahedron-N28-r0001";
  const auto same = isojam({"rerun", "results", name}, here_.path());
  EXPECT_EQ(same.exit_code, 0) << same.err;
  EXPECT_EQ(same.out, name + ": the result has the same bits as the record\n");
  EXPECT_NE(same.err.find("decompression at density"), std::string::npos) << same.err;
  const auto as_json = isojam({"rerun", "results", name, "--json"}, here_.path());
  EXPECT_NE(as_json.err.find("the same bits"), std::string::npos) << as_json.err;
  EXPECT_EQ(parse_sealed(as_json.out, "stdout").at("status"), "done");
  EXPECT_EQ(results(), reference());
  for (const std::string wrong : {"dodecahedron-N28-r001", "../m", "dodecahedron-N28-r0002", ""}) {
    const auto refused = isojam({"rerun", "results", wrong}, here_.path());
    EXPECT_EQ(refused.exit_code, 2) << wrong;
    EXPECT_EQ(refused.out, "");
  }
  EXPECT_NE(isojam({"rerun", "results", "dodecahedron-N28-r001"}, here_.path()).err.find("did you mean"),
            std::string::npos);
}

TEST_F(Crash, ADryRunWritesNothing) {
  const auto fresh = isojam({"run", "m.json", "-o", "results", "--dry-run"}, here_.path());
  EXPECT_EQ(fresh.exit_code, 0) << fresh.err;
  EXPECT_NE(fresh.out.find("dodecahedron N=28: 2 replicates, 0 recorded"), std::string::npos) << fresh.out;
  EXPECT_FALSE(fs::exists(here_ / "results"));
  copy_reference();
  const auto before = test::files_below(here_.path());
  const auto done = isojam({"run", "m.json", "-o", "results", "--dry-run"}, here_.path());
  EXPECT_NE(done.out.find("remaining: nothing"), std::string::npos) << done.out;
  EXPECT_EQ(test::files_below(here_.path()), before);
  fs::remove(here_ / "results" / "records" / "dodecahedron-N28-r0001.json");
  const auto rest = isojam({"run", "m.json", "-o", "results", "--dry-run"}, here_.path());
  EXPECT_NE(rest.out.find("times estimated from 5 records of this directory"), std::string::npos) << rest.out;
}

}  // namespace
}  // namespace isojam
