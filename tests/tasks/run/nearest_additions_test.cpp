#include <gtest/gtest.h>

#include <map>

#include "tasks/io/parse.hpp"
#include "tasks/io/sealed.hpp"
#include "tasks/records/recorded.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using test::isojam;

class AddingToNearest : public testing::Test {
 protected:
  void run(Json manifest, const std::string& directory) {
    test::write_text(here_ / (directory + ".json"), manifest.dump());
    const auto done = isojam({"run", directory + ".json", "-o", directory}, here_.path());
    ASSERT_EQ(done.exit_code, 0) << done.err;
  }
  test::Finished add(const std::string& measures) const {
    auto done = isojam({"measure", "few", "--add", measures}, here_.path());
    EXPECT_EQ(done.exit_code, 0) << done.err;
    return done;
  }
  Json record(const std::string& directory, const std::string& name) const {
    return read_sealed((here_ / directory / "records" / (name + ".json")).string());
  }
  std::vector<std::string> names() const { return names_in(here_ / "few" / "records"); }

  test::TemporaryDirectory here_;
};

TEST_F(AddingToNearest, GivesTheValuesOfARunWithAllMeasures) {
  auto manifest = test::tiny_manifest();
  manifest["measure"] = {"contacts", "modes", "moduli", "rigidity"};
  run(manifest, "all");
  manifest["measure"] = {"contacts"};
  run(manifest, "few");
  for (const std::string each : {"rigidity", "modes,moduli"}) {
    const auto done = add(each);
    EXPECT_NE(done.err.find("\"keep_path\": true saves them"), std::string::npos) << done.err;
    EXPECT_NE(done.out.find("measured only for the state nearest jamming (replicates): "), std::string::npos)
        << done.out;
  }
  const auto count = names().size();
  const Json marked{{"modes", count}, {"moduli", count}, {"rigidity", count}};
  const auto tables = read_sealed((here_ / "few" / "tables.json").string());
  EXPECT_EQ(tables.at("nearest_only"), marked);
  EXPECT_EQ(test::violations("tables", tables), "");
  for (const auto& name : names()) {
    const auto added = record("few", name), expected = record("all", name);
    EXPECT_EQ(added.at("nearest_only"), Json({"modes", "moduli", "rigidity"}));
    EXPECT_EQ(added.at("phi_j"), expected.at("phi_j"));
    for (const std::string measure : {"contacts", "modes", "moduli", "rigidity"})
      EXPECT_EQ(test::nearest_of(added).at(measure), test::nearest_of(expected).at(measure)) << name << " " << measure;
    EXPECT_TRUE(added.at("states").front().contains("contacts"));
    EXPECT_FALSE(added.at("states").front().contains("modes")) << "only the nearest state is stored";
    EXPECT_EQ(test::violations("record", added), "");
  }
  const auto states = isojam({"export", "few", "all", "--format", "states"}, here_.path());
  EXPECT_NE(states.out.find("omega_l: only the state nearest jamming was measured"), std::string::npos);
  manifest["keep_path"] = true;
  run(manifest, "few");
  for (const auto& name : names())
    EXPECT_EQ(record("few", name).at("result_digest"), record("all", name).at("result_digest")) << name;
}

TEST_F(AddingToNearest, RelaxesASaddle) {
  run(parse_json(
          R"({"name": "saddle", "seed": 9, "minimiser": {"method": "newton"}, "sweep": {"solid": ["icosahedron"], "particles": [40]},
                     "replicates": 4, "protocol": {"final_distance": 0.015, "compression_evaluations": 2000}, "measure": ["contacts"]})",
          "saddle"),
      "few");
  std::map<std::string, Json> before;
  for (const auto& name : names()) before[name] = record("few", name);
  add("modes");
  int moved = 0;
  for (const auto& name : names()) {
    const auto now = record("few", name);
    const auto& nearest = test::nearest_of(now);
    const bool is_moved = nearest.at("descents") > 0;
    moved += is_moved;
    EXPECT_EQ(nearest.at("modes").at("negative"), 0) << name;
    const auto packing = read_sealed((here_ / "few" / "packings" / (name + ".json")).string());
    EXPECT_EQ(packing.at("result_digest") == now.at("result_digest"), is_moved) << name;
    EXPECT_EQ(now.at("states").front().at("contacts"), before.at(name).at("states").front().at("contacts"));
    EXPECT_EQ(nearest.at("contacts") == test::nearest_of(before.at(name)).at("contacts"), !is_moved) << name;
  }
  EXPECT_GT(moved, 0) << "no nearest state is a saddle: choose another seed";
  EXPECT_EQ(isojam({"status", "few"}, here_.path()).exit_code, 0);
  add("rigidity");
}

}  // namespace
}  // namespace isojam
