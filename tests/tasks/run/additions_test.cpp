#include "tasks/run/additions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <thread>

#include "tasks/io/directory_lock.hpp"
#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/store.hpp"
#include "tasks/run/graph.hpp"
#include "tests/tasks/run/failing.hpp"
#include "tests/tasks/run/first_table.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

namespace fs = std::filesystem;
using test::files_below;
using test::isojam;
using test::TemporaryDirectory;

const std::string rest = "order,clusters,modes,moduli,rigidity";

/// The part of a record that a run from the start has too.
Json without_history(Json record) {
  record.erase("provenance");
  return test::without_checksum(std::move(record));
}

/// A run that measured contacts and kept its paths, and a run that measured everything. All tests share them.
class Adding : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    shared_ = std::make_unique<TemporaryDirectory>();
    auto manifest = test::tiny_manifest();
    manifest["keep_path"] = true;
    test::write_text(*shared_ / "all.json", manifest.dump());
    manifest["measure"] = {"contacts"};
    test::write_text(*shared_ / "few.json", manifest.dump());
    all_ = isojam({"run", "all.json", "-o", "all"}, shared_->path());
    few_ = isojam({"run", "few.json", "-o", "few"}, shared_->path());
  }
  static void TearDownTestSuite() { shared_.reset(); }

  void SetUp() override {
    ASSERT_EQ(all_.exit_code, 0) << all_.err;
    ASSERT_EQ(few_.exit_code, 0) << few_.err;
    fs::copy(shared_->path(), here_.path(), fs::copy_options::recursive);
  }

  test::Finished measure(std::vector<std::string> arguments, const std::function<void(int)>& meanwhile = {}) const {
    arguments.insert(arguments.begin(), {"measure", "few"});
    return isojam(arguments, here_.path(), meanwhile);
  }
  Json record(const std::string& directory, const std::string& name) const {
    return read_sealed((here_ / directory / "records" / (name + ".json")).string());
  }
  std::vector<std::string> names() const { return names_in(here_ / "few" / "records"); }
  /// Checks everything except tables, and except timing and provenance of records.
  void expect_as_if_from_the_start() const {
    for (const auto& name : names()) {
      const auto added = record("few", name), expected = record("all", name);
      EXPECT_EQ(added.at("result_digest"), expected.at("result_digest")) << name;
      EXPECT_TRUE(pretty(without_history(added)) == pretty(without_history(expected))) << name;
    }
  }

  // NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables): GoogleTest's way to share a costly set-up.
  static inline std::unique_ptr<TemporaryDirectory> shared_;
  static inline test::Finished all_, few_;
  // NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)
  TemporaryDirectory here_;
};

bool has_moved(const Json& record) {
  const auto& states = record.at("states");
  return std::any_of(states.begin(), states.end(), [](const Json& state) { return state.at("descents") > 0; });
}

TEST_F(Adding, GivesTheRecordsOfARunWithAllMeasures) {
  const auto before = files_below(here_ / "few");
  const auto done = measure({"--add", rest, "-j", "2"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  expect_as_if_from_the_start();
  EXPECT_EQ(test::first_table(done.out), test::first_table(all_.out));
  const auto after = files_below(here_ / "few");
  for (const auto& name : names()) {
    const auto now = record("few", name);
    for (const std::string folder : {"packings/", "paths/"}) {
      const auto file = folder + name + ".json";
      EXPECT_TRUE(after.at(file) == before.at(file)) << file;
    }
    const auto& added = now.at("provenance").at("added");
    ASSERT_EQ(added.size(), 1U);
    EXPECT_EQ(added[0].at("measures"), Json({"order", "clusters", "modes", "moduli", "rigidity"}));
    EXPECT_EQ(added[0].at("before").at("result_digest"),
              parse_json(before.at("records/" + name + ".json"), name).at("result_digest"));
    EXPECT_EQ(test::violations("record", now), "");
  }
}

TEST_F(Adding, RelaxesSaddlesAsARunDoes) {
  auto manifest = parse_json(
      R"({"name": "saddle", "seed": 7, "minimiser": {"method": "newton"}, "sweep": {"solid": ["icosahedron"], "particles": [40]},
                                 "replicates": 1, "protocol": {"final_distance": 0.015, "compression_evaluations": 2000}, "keep_path": true,
                                 "measure": ["contacts", "clusters", "modes"]})",
      "saddle");
  fs::remove_all(here_ / "few"), fs::remove_all(here_ / "all");
  test::write_text(here_ / "all.json", manifest.dump());
  manifest["measure"] = {"clusters"};
  test::write_text(here_ / "few.json", manifest.dump());
  for (const std::string name : {"few", "all"})
    ASSERT_EQ(isojam({"run", name + ".json", "-o", name}, here_.path()).exit_code, 0);
  const auto name = names().front();
  fs::copy(here_ / "few", here_ / "killed", fs::copy_options::recursive);
  ASSERT_FALSE(has_moved(record("few", name)));
  ASSERT_TRUE(has_moved(record("all", name))) << "no state of this packing is a saddle: choose another";
  ASSERT_EQ(measure({"--add", "contacts"}).exit_code, 0);
  ASSERT_EQ(measure({"--add", "modes"}).exit_code, 0);
  expect_as_if_from_the_start();
  for (const std::string folder : {"packings", "paths"}) {
    auto moved = read_sealed((here_ / "few" / folder / (name + ".json")).string());
    EXPECT_EQ(moved, read_sealed((here_ / "all" / folder / (name + ".json")).string())) << folder;
    // As a process leaves it that was killed before it wrote the record.
    fs::copy_file(here_ / "few" / folder / (name + ".json"), here_ / "killed" / folder / (name + ".json"),
                  fs::copy_options::overwrite_existing);
  }
  fs::copy_file(here_ / "few" / "manifest.json", here_ / "killed" / "manifest.json",
                fs::copy_options::overwrite_existing);
  EXPECT_EQ(isojam({"measure", "killed"}, here_.path()).exit_code, 1);
  EXPECT_EQ(isojam({"run", "all.json", "-o", "killed"}, here_.path()).exit_code, 0);
  EXPECT_EQ(record("killed", name).at("result_digest"), record("all", name).at("result_digest"));
}

TEST_F(Adding, OneAfterAnotherGivesTheSame) {
  for (const auto* each : {"rigidity", "modes", "order,moduli", "clusters"})
    ASSERT_EQ(measure({"--add", each, "-j", "1"}).exit_code, 0) << each;
  expect_as_if_from_the_start();
  EXPECT_EQ(record("few", names().front()).at("provenance").at("added").size(), 4U);
  const auto again = files_below(here_ / "few");
  EXPECT_EQ(measure({"--add", "modes"}).exit_code, 0);
  const auto nothing = measure({});
  EXPECT_EQ(nothing.exit_code, 0);
  EXPECT_EQ(nothing.err.find("adding measures"), std::string::npos) << nothing.err;
  EXPECT_EQ(files_below(here_ / "few"), again) << "nothing was left to add";
}

TEST_F(Adding, LeavesAValidDirectory) {
  ASSERT_EQ(measure({"--add", rest}).exit_code, 0);
  const auto files = files_below(here_ / "few/records");
  const auto status = isojam({"status", "few"}, here_.path());
  EXPECT_EQ(status.out.find("problem: "), std::string::npos) << status.out;
  EXPECT_EQ(status.out.find("without measures"), std::string::npos) << status.out;
  for (const auto* manifest : {"all.json", "few.json"}) {
    const auto run = isojam({"run", manifest, "-o", "few"}, here_.path());
    EXPECT_EQ(run.exit_code, 0) << run.err;
    EXPECT_EQ(test::first_table(run.out), test::first_table(all_.out)) << manifest;
    EXPECT_EQ(files_below(here_ / "few/records"), files) << manifest << " ran something again";
  }
  for (const auto& name : names()) {
    const auto path = read_sealed((here_ / "few" / "paths" / (name + ".json")).string());
    EXPECT_EQ(test::violations("path", path), "") << name;
  }
  const auto exported = isojam({"export", "few", "all", "--format", "contacts", "--path"}, here_.path());
  EXPECT_EQ(exported.exit_code, 0) << exported.err;
  const auto rerun = isojam({"rerun", "few", names().front()}, here_.path());
  EXPECT_EQ(rerun.out, names().front() + ": the result has the same bits as the record\n");
}

TEST_F(Adding, ContinuesAfterAKill) {
  const auto original = record("few", names().front()).at("result_digest");
  measure({"--add", "rigidity,modes", "-j", "1"}, [&](int process) {
    // Kill it as soon as the first record has been replaced.
    for (int k = 0; k < 200000 && record("few", names().front()).at("result_digest") == original; ++k)
      std::this_thread::sleep_for(std::chrono::microseconds(500));
    ::kill(process, SIGKILL);
  });
  const auto lacks = [&](const std::string& name) {
    const auto measures = record("few", name).at("spec").at("measure");
    return std::find(measures.begin(), measures.end(), "modes") == measures.end();
  };
  const auto all = names();
  const auto lacking = std::count_if(all.begin(), all.end(), lacks);
  const auto status = isojam({"status", "few"}, here_.path());
  EXPECT_EQ(status.out.find("problem: "), std::string::npos) << status.out;
  if (lacking > 0) {
    const auto line = std::to_string(lacking) + (lacking == 1 ? " record " : " records ") + "without measures";
    EXPECT_NE(status.out.find(line), std::string::npos) << status.out;
  }
  ASSERT_EQ(measure({}).exit_code, 0);
  ASSERT_EQ(measure({"--add", "order,clusters,moduli"}).exit_code, 0);
  expect_as_if_from_the_start();
}

TEST_F(Adding, OfOnlyOneReplicate) {
  const auto all = names();
  ASSERT_EQ(measure({"--add", rest, "--only", all[1]}).exit_code, 0);
  for (const auto& name : all) {
    const bool whole = record("few", name).at("result_digest") == record("all", name).at("result_digest");
    EXPECT_EQ(whole, name == all[1]) << name;
  }
  EXPECT_EQ(isojam({"aggregate", "few"}, here_.path()).exit_code, 0) << "tables take what there is";
  EXPECT_EQ(measure({"--only", "dodecahedron-N24-r000"}).err.find("did you mean \"dodecahedron-N24-r0000\"") !=
                std::string::npos,
            true);
  ASSERT_EQ(measure({}).exit_code, 0);
  expect_as_if_from_the_start();
}

TEST_F(Adding, ARunRecomputesRecordsThatLackAMeasure) {
  const auto all = names();
  ASSERT_EQ(measure({"--add", rest, "--only", all[1]}).exit_code, 0);
  const auto plan = isojam({"run", "all.json", "-o", "few", "--dry-run"}, here_.path());
  EXPECT_NE(plan.out.find("3 records without measures"), std::string::npos) << plan.out;
  const auto path = here_ / "few" / "paths" / (all[2] + ".json");
  fs::remove(path);
  const auto measured = measure({});
  EXPECT_EQ(measured.exit_code, 0);
  EXPECT_NE(measured.err.find("for 1 of 3 records, the states of the decompression were not saved"), std::string::npos)
      << measured.err;
  const auto run = isojam({"run", "all.json", "-o", "few"}, here_.path());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(test::first_table(run.out), test::first_table(all_.out));
  expect_as_if_from_the_start();
  EXPECT_TRUE(fs::exists(path));
  // Without the manifest, the records still show that they belong to this sweep, and keep their other measures.
  fs::remove(here_ / "few" / "manifest.json");
  const auto before = files_below(here_ / "few" / "records");
  EXPECT_EQ(isojam({"run", "few.json", "-o", "few"}, here_.path()).exit_code, 0);
  EXPECT_EQ(files_below(here_ / "few" / "records"), before);
  EXPECT_EQ(measure({"--add", rest}).exit_code, 0);
  EXPECT_EQ(files_below(here_ / "few" / "records"), before);
}

TEST_F(Adding, LeavesARecordThatAnotherProcessChanged) {
  const std::vector measures{Measure::contacts, Measure::order};
  auto manifest = own_manifest(here_ / "few");
  manifest.measures = measures;
  const Store store(here_ / "few", manifest, test::unheard);
  const Requests requests{Plan(manifest)};
  const auto found = additions(here_ / "few", requests, measures, names());
  ASSERT_EQ(found.measured.size(), names().size());
  Adder adder(store, found.measured);
  const auto changed = names().front();
  const NextReplicate next = [&, at = std::size_t{0}]() mutable {
    return at < found.measured.size() ? std::optional(found.measured[at++]) : std::nullopt;
  };
  run_graph(next, adder.stages(), {1, 0, {}, {}}, [&](const Outcome& outcome) {
    const auto file = store.record_path(outcome.spec);
    const bool is_changed = replicate_name(outcome.spec) == changed;
    auto other = read_sealed(file.string());
    other.at("timing").at("cpu_seconds") = 3600.0;
    other.erase("checksum");
    const auto text = sealed(other);
    if (is_changed) test::write_text(file, text);
    const auto problem = adder.finish(outcome);
    EXPECT_EQ(problem.value_or("").find("was changed by another process") != std::string::npos, is_changed);
    EXPECT_EQ(read_file(file) == text, is_changed);
  });
  const auto lacking = additions(here_ / "few", requests, measures, names()).measured;
  ASSERT_EQ(lacking.size(), 1U);
  EXPECT_EQ(replicate_name(lacking.front()), changed);
}

TEST_F(Adding, HasTheDirectoryForItself) {
  auto more = parse_json(read_file(here_ / "few.json"), "few.json");
  more["replicates"] = more.at("replicates").get<int>() + 1;
  test::write_text(here_ / "more.json", more.dump());
  const auto before = files_below(here_ / "few");
  for (const auto kind : {DirectoryLock::Kind::shared, DirectoryLock::Kind::exclusive}) {
    const auto held = DirectoryLock::take(here_ / "few", kind);
    ASSERT_TRUE(held);
    std::vector<std::vector<std::string>> refused{{"measure", "few", "--add", "modes"}};
    if (kind == DirectoryLock::Kind::exclusive) {
      refused.push_back({"run", "more.json", "-o", "few"});
      refused.push_back({"rerun", "few", names().front()});
    } else {
      EXPECT_EQ(isojam({"run", "few.json", "-o", "few"}, here_.path()).exit_code, 0);
    }
    for (const auto& command : refused) {
      const auto ended = isojam(command, here_.path());
      EXPECT_EQ(ended.exit_code, 1) << command[0];
      EXPECT_NE(ended.err.find("another process of isojam is using this directory"), std::string::npos) << ended.err;
    }
  }
  EXPECT_EQ(files_below(here_ / "few"), before);
  EXPECT_EQ(measure({"--add", "rigidity"}).exit_code, 0) << "the lock went with its holder";
}

TEST_F(Adding, AFailedReplicateHasReasonsForAddedMeasures) {
  for (const std::string name : {"few", "all"}) {
    auto manifest = parse_json(read_file(here_ / (name + ".json")), name);
    manifest["protocol"]["max_steps"] = 2;
    test::write_text(here_ / (name + "2.json"), manifest.dump());
    fs::remove_all(here_ / name);
    ASSERT_EQ(isojam({"run", name + "2.json", "-o", name}, here_.path()).exit_code, 1);
  }
  const auto done = measure({"--add", rest});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  expect_as_if_from_the_start();
}

TEST_F(Adding, ReportsErrorsBeforeAnythingIsWritten) {
  const auto untouched = [&](const std::vector<std::string>& arguments, int code, const std::string& said) {
    const auto before = files_below(here_ / "few");
    const auto result = measure(arguments);
    EXPECT_EQ(result.exit_code, code) << result.err;
    EXPECT_NE(result.err.find(said), std::string::npos) << result.err << "\nwanted: " << said;
    EXPECT_EQ(files_below(here_ / "few"), before) << said;
  };
  untouched({"--add", "cluster"}, 2, "did you mean \"clusters\"");
  untouched({"--add", ""}, 2, "unknown measure \"\"");
  untouched({"--add", "modes", "--only", "tetrahedron"}, 2, "unknown replicate \"tetrahedron\"");
  const auto path = here_ / "few" / "paths" / (names().back() + ".json");
  const auto content = read_file(path);
  auto damaged = content;
  damaged[content.size() / 2] ^= 1;
  test::write_text(path, damaged);
  untouched({"--add", "modes", "--only", names().front()}, 65, "the file is damaged");
  test::write_text(path, content);
  const auto theirs = here_ / "few" / "records" / (names().front() + ".json");
  auto text = read_file(theirs);
  const std::string seed = "\"seed\": 7";
  text.replace(text.find(seed), seed.size(), "\"seed\": 8");
  test::write_text(theirs, test::sealed_again(text));
  untouched({"--add", "rigidity"}, 65, "contains results of another manifest");
}

}  // namespace
}  // namespace isojam
