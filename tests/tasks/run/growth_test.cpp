#include <gtest/gtest.h>

#include <filesystem>

#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/recorded.hpp"
#include "tests/tasks/run/first_table.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::files_below;
using test::isojam;

class Growth : public testing::Test {
 protected:
  test::Finished run(const Json& manifest, const std::string& directory = "r") const {
    test::write_text(here_ / "m.json", manifest.dump());
    return isojam({"run", "m.json", "-o", directory}, here_.path());
  }
  Json record(const std::string& directory, const std::string& name) const {
    return read_sealed((here_ / directory / "records" / (name + ".json")).string());
  }
  std::vector<std::string> names(const std::string& directory) const { return names_in(here_ / directory / "records"); }

  test::TemporaryDirectory here_;
};

Json small() {
  auto manifest = test::tiny_manifest();
  manifest["sweep"] = {{"solid", {"dodecahedron"}}, {"particles", {24}}, {"final_distance", {0.03}}};
  manifest["protocol"].erase("final_distance");
  manifest["measure"] = {"contacts"};
  return manifest;
}

Json large() {
  auto manifest = small();
  manifest["sweep"] = {
      {"solid", {"dodecahedron", "icosahedron"}}, {"particles", {24, 28}}, {"final_distance", {0.03, 0.04}}};
  return manifest;
}

TEST_F(Growth, MoreMeasuresAreComputedWithThoseOfTheRecord) {
  ASSERT_EQ(run(small()).exit_code, 0);
  auto more = small();
  more["measure"] = {"order"};
  const auto changed = run(more);
  EXPECT_EQ(changed.exit_code, 0) << changed.err;
  EXPECT_NE(changed.err.find("\"isojam measure\" would add them in less time"), std::string::npos) << changed.err;
  for (const auto& name : names("r")) {
    for (const std::string measure : {"contacts", "order"})
      EXPECT_TRUE(test::nearest_of(record("r", name)).contains(measure)) << name;
  }
}

TEST_F(Growth, GivesTheResultsOfTheLargerManifest) {
  ASSERT_EQ(run(small()).exit_code, 0);
  const auto before = files_below(here_ / "r/records");
  const auto grown = run(large());
  ASSERT_EQ(grown.exit_code, 0) << grown.err;
  const auto whole = run(large(), "whole");
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  EXPECT_EQ(test::first_table(grown.out), test::first_table(whole.out));
  EXPECT_EQ(names("r"), names("whole"));
  for (const auto& name : names("whole"))
    EXPECT_EQ(record("r", name).at("result_digest"), record("whole", name).at("result_digest")) << name;
  const auto after = files_below(here_ / "r");
  for (const auto& [file, text] : before) EXPECT_TRUE(after.at("records/" + file) == text) << file;
  for (const std::vector<std::string>& command : {std::vector<std::string>{"run", "m.json", "-o", "r"},
                                                  {"aggregate", "r"},
                                                  {"status", "r"},
                                                  {"export", "r", "all", "--format", "contacts"},
                                                  {"report", "r"},
                                                  {"run", "m.json", "-o", "r", "--dry-run"}}) {
    const auto used = isojam(command, here_.path());
    EXPECT_EQ(used.exit_code, 0) << command[0] << used.err;
    EXPECT_EQ(used.err.find("another manifest"), std::string::npos) << command[0] << used.err;
    EXPECT_EQ(used.out.find("another manifest"), std::string::npos) << command[0] << used.out;
  }
  const auto kept = files_below(here_ / "r/records");
  EXPECT_EQ(run(small()).exit_code, 0);
  EXPECT_EQ(files_below(here_ / "r/records"), kept);
}

TEST_F(Growth, RefusesNamesThatAreTaken) {
  ASSERT_EQ(run(small()).exit_code, 0);
  const auto before = files_below(here_ / "r");
  const auto refused = [&](const Json& manifest, const std::string& said) {
    const auto dry_run = [&] { return isojam({"run", "m.json", "-o", "r", "--dry-run"}, here_.path()); };
    for (const auto& ended : {run(manifest), dry_run()}) {
      EXPECT_EQ(ended.exit_code, 65) << said;
      EXPECT_NE(ended.err.find(said), std::string::npos) << ended.err;
    }
    EXPECT_TRUE(files_below(here_ / "r") == before) << said;
  };
  auto changed = large();
  changed["seed"] = 8;
  refused(changed, "/provenance/seed: 7 in the record, 8 in this manifest");
  changed = large();
  changed["minimiser"]["residual"] = 1e-4;
  refused(changed, "/minimiser/residual");
  changed = small();
  changed["protocol"]["by_solid"] = {{"dodecahedron", {{"max_density", 0.99}}}};
  refused(changed, "0.93 in the record, 0.99 in this manifest");
}

TEST_F(Growth, CubesReachTheTargetEnergy) {
  // With max_density 0.93, this replicate ends with density_limit.
  const auto ended = run(parse_json(R"({"name": "cubes", "seed": 42, "sweep": {"solid": ["cube"], "particles": [64]},
                                        "replicates": 1, "protocol": {"final_distance": 0.03, "fit_window": 0.1},
                                        "measure": ["order"]})",
                                    "cubes"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.err.find("warning"), std::string::npos) << ended.err;
  const auto made = record("r", "cube-N64-r0000");
  EXPECT_EQ(made.at("flags"), Json({"crystalline"})) << "found by the orientations alone";
}

TEST_F(Growth, AReportShowsSeveralDirectories) {
  ASSERT_EQ(run(small()).exit_code, 0);
  auto manifest = small();
  manifest["seed"] = 8;
  ASSERT_EQ(run(manifest, "other").exit_code, 0);
  EXPECT_EQ(isojam({"report", "r", "other"}, here_.path()).exit_code, 2);
  const auto made = isojam({"report", "r", "other", "-o", "both.html"}, here_.path());
  EXPECT_EQ(made.exit_code, 0) << made.err;
  const auto page = test::files_below(here_.path()).at("both.html");
  for (const std::string name :
       {"r/dodecahedron-N24-final_distance0.03-r0000", "other/dodecahedron-N24-final_distance0.03-r0001"})
    EXPECT_NE(page.find(name), std::string::npos) << name;
}

}  // namespace
}  // namespace isojam
