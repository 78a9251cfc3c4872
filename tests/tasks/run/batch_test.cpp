#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tests/tasks/run/first_table.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using test::files_below;
using test::isojam;
using test::results_below;
using test::TemporaryDirectory;

using Files = std::map<std::string, std::string>;

/// A complete run with one thread. All tests share it, and each works on its own copy.
class Batch : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryDirectory>();
    test::write_text(*shared_ / "m.json", test::tiny_manifest().dump());
    finished_ = isojam({"run", "m.json", "-o", "results", "-j", "1"}, shared_->path());
  }
  static void TearDownTestSuite() { shared_.reset(); }

  void SetUp() override {
    ASSERT_EQ(finished_.exit_code, 0) << finished_.err;
    fs::copy(shared_->path(), here_.path(), fs::copy_options::recursive);
  }

  test::Finished run(const std::string& manifest = "m.json", const std::function<void(int)>& meanwhile = {}) {
    return isojam({"run", manifest, "-o", "results", "-j", "2"}, here_.path(), meanwhile);
  }
  void edit_manifest(const std::function<void(Json&)>& change) {
    auto manifest = test::tiny_manifest();
    change(manifest);
    test::write_text(here_ / "m.json", manifest.dump());
  }
  static Files reference() { return results_below(*shared_ / "results"); }
  Files results() const { return results_below(here_ / "results"); }

  // NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): GoogleTest's way to share a costly set-up.
  static inline std::unique_ptr<TemporaryDirectory> shared_;
  static inline test::Finished finished_;
  // NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
  TemporaryDirectory here_;
};

Files only(const Files& files, const std::string& part) {
  Files some;
  for (const auto& [name, content] : files) {
    if (name.find(part) != std::string::npos) some[name] = content;
  }
  return some;
}

TEST_F(Batch, ThreadsChangeNoByte) {
  fs::remove_all(here_ / "results");
  const auto second = run();
  EXPECT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(second.out, finished_.out);
  EXPECT_EQ(results(), reference());
  EXPECT_EQ(results().size(), 10U) << "4 records, 4 packings, manifest, tables";
}

TEST_F(Batch, EverythingConformsToTheSchemas) {
  int checked = 0;
  for (const auto& [name, content] : files_below(here_ / "results")) {
    if (name == "checkpoints/.locks") continue;
    const auto schema = name == "tables.json"             ? "tables"
                        : name.starts_with("manifest")    ? "manifest"
                        : name.rfind("packings/", 0) == 0 ? "packing"
                                                          : "record";
    EXPECT_EQ(test::violations(schema, parse_json(content, name)), "") << name;
    ++checked;
  }
  EXPECT_EQ(checked, 11);
}

/// Number of records in a directory; 0 if the directory does not exist.
std::size_t count_records(const fs::path& results) {
  std::size_t count = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(results / "records", error)) {
    count += entry.path().extension() == ".json";
  }
  return count;
}

TEST_F(Batch, AnInterruptedRunContinues) {
  fs::remove_all(here_ / "results");
  // First before there is any record, then after the first record.
  for (const auto& [signal, records] : {std::pair{SIGTERM, std::size_t{0}}, {SIGINT, std::size_t{1}}}) {
    const auto stopped = run("m.json", [&, wanted = records, which = signal](int process) {
      for (int i = 0; i < 60000; ++i) {
        if (fs::exists(here_ / "results" / "packings") && count_records(here_ / "results") >= wanted) break;
        std::this_thread::sleep_for(5ms);
      }
      kill(process, which);
    });
    EXPECT_EQ(stopped.exit_code, 75) << stopped.err;
    EXPECT_EQ(stopped.out, "");
    EXPECT_NE(stopped.err.find("repeat the command to resume"), std::string::npos) << stopped.err;
    EXPECT_LT(count_records(here_ / "results"), 4U);
    EXPECT_FALSE(fs::exists(here_ / "results" / "tables.json"));
  }
  const auto status = isojam({"status", "results"}, here_.path());
  EXPECT_NE(status.out.find(" 0 running"), std::string::npos) << status.out;
  EXPECT_NE(status.out.find("no process works in this directory"), std::string::npos) << status.out;
  const auto completed = run();
  EXPECT_EQ(completed.exit_code, 0) << completed.err;
  EXPECT_EQ(completed.out, finished_.out);
  EXPECT_EQ(results(), reference());
}

TEST_F(Batch, AReplicateIsTheSameInAnotherSweep) {
  edit_manifest([](Json& manifest) {
    manifest["name"] = "alone";
    manifest["sweep"]["particles"] = {28};
    manifest["replicates"] = 1;
  });
  fs::remove_all(here_ / "results");
  ASSERT_EQ(run().exit_code, 0);
  const auto name = "dodecahedron-N28-r0000.json";
  const auto ours = results(), theirs = reference();
  EXPECT_EQ(ours.at(std::string("records/") + name), theirs.at(std::string("records/") + name));
  EXPECT_EQ(ours.at(std::string("packings/") + name), theirs.at(std::string("packings/") + name));
}

TEST_F(Batch, FailedReplicatesAreRecordedAndCounted) {
  edit_manifest([](Json& manifest) {
    manifest["sweep"]["particles"] = {24};
    manifest["sweep"]["max_steps"] = {2, 400};
    manifest["replicates"] = 1;
  });
  fs::remove_all(here_ / "results");
  const auto first = run();
  EXPECT_EQ(first.exit_code, 1) << first.err;
  const auto rows = read_json((here_ / "results" / "tables.json").string()).at("rows");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows.at(0).at("parameters").at("max_steps"), 2);
  EXPECT_EQ(rows.at(0).at("failed"), 1);
  EXPECT_EQ(rows.at(1).at("failed"), 0);
  int failed = 0;
  for (const auto& [name, content] : only(files_below(here_ / "results"), "records/")) {
    const auto record = parse_json(content, name);
    EXPECT_EQ(test::violations("record", record), "") << name;
    if (record.at("status") != "failed") continue;
    ++failed;
    EXPECT_EQ(record.at("failure").at("where"), "jam");
    EXPECT_EQ(record.at("failure").at("why").get<std::string>().rfind("step_limit after 2 strain steps", 0), 0U)
        << record.at("failure");
    EXPECT_EQ(record.at("path").size(), 2U);
  }
  EXPECT_EQ(failed, 1);
  const auto before = files_below(here_ / "results");
  EXPECT_EQ(run().exit_code, 1) << "a failure on record still counts";
  EXPECT_EQ(files_below(here_ / "results"), before);
}

TEST_F(Batch, AggregateMakesTheSameTables) {
  const auto before = files_below(here_ / "results");
  const auto text = isojam({"aggregate", "results", "-o", "again.json"}, here_.path());
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_EQ(test::first_table(text.out), test::first_table(finished_.out));
  EXPECT_EQ(read_text((here_ / "again.json").string()), before.at("tables.json"));
  const auto json = isojam({"aggregate", "results", "results", "--format", "json"}, here_.path());
  EXPECT_EQ(json.out, before.at("tables.json")) << "a directory given twice counts once";
  for (const std::string format : {"csv", "latex"}) {
    const auto other = isojam({"aggregate", "results", "--format", format}, here_.path());
    EXPECT_EQ(other.exit_code, 0) << other.err;
    EXPECT_NE(other.out.find("dodecahedron"), std::string::npos) << other.out;
  }
  EXPECT_EQ(files_below(here_ / "results"), before);
}

TEST_F(Batch, QuietPrintsNothingAndVerboseNamesEveryReplicate) {
  for (const auto& [option, lines] : {std::pair{"--quiet", 0}, {"-v", 4}}) {
    fs::remove_all(here_ / "results");
    const auto told = isojam({option, "run", "m.json", "-o", "results"}, here_.path());
    EXPECT_EQ(told.out, finished_.out);
    int named = 0;
    for (auto at = told.err.find(": phi_j "); at != std::string::npos; at = told.err.find(": phi_j ", at + 1)) ++named;
    EXPECT_EQ(named, lines) << told.err;
    EXPECT_EQ(told.err.empty(), lines == 0) << told.err;
  }
}

}  // namespace
}  // namespace isojam
