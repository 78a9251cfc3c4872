#include <gtest/gtest.h>

#include <algorithm>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/packings/packing_json.hpp"
#include "tests/tasks/support/schema.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

Json kind(const std::string& solid, double fraction, const Json& size = 1) {
  return {{"solid", solid}, {"fraction", fraction}, {"size", size}};
}

Json mixture(const std::vector<Json>& kinds) { return {{"mixture", kinds}}; }

Json swept(const std::vector<Json>& entries, int particles = 300) {
  auto manifest = test::tiny_manifest();
  manifest["sweep"]["solid"] = entries;
  manifest["sweep"]["particles"] = {particles};
  return manifest;
}

const Json two_sizes = mixture({kind("octahedron", .5), kind("octahedron", .5, 1.4)});
const Json two_shapes = mixture({kind("cube", .5), kind("tetrahedron", .5)});
const Json by_law = mixture(
    {kind("cube", .5, {{"log_normal", {{"sigma", .3}}}}), kind("octahedron", .25, {{"uniform", {.8, 1.2}}}),
     kind("icosahedron", .25, {{"discrete", {{{"size", 1}, {"fraction", .5}}, {{"size", 1.5}, {"fraction", .5}}}}})});

Manifest parse(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

TEST(Mixtures, AreEntriesOfASweep) {
  auto json = swept({"cube", two_sizes, two_shapes, by_law});
  json["solids"] = {{"brick", {{"box", {1, 1.5, 2}}}}};
  json["sweep"]["solid"].push_back(mixture({kind("brick", .5), kind("cube", .5)}));
  json["sweep"]["solid"].back()["name"] = "bricks_and_cubes";
  const auto manifest = parse(json);
  std::vector<std::string> names;
  for (const auto& each : manifest.solids) names.emplace_back(to_string(each));
  EXPECT_EQ(names.front(), "cube") << "single solids come first";
  for (const std::string name : {"octahedron_0.5+octahedronx1.4_0.5", "cube_0.5+tetrahedron_0.5", "bricks_and_cubes"})
    EXPECT_EQ(std::count(names.begin(), names.end(), name), 1) << name;
  EXPECT_TRUE(std::any_of(names.begin(), names.end(), [](const auto& name) { return name.starts_with("mixture_"); }))
      << "a name of 48 letters at most";
  const auto canonical = to_json(manifest);
  EXPECT_EQ(to_json(parse(canonical)), canonical);
  EXPECT_EQ(parse(canonical).solids, manifest.solids);
  EXPECT_TRUE(canonical.at("solids").contains("brick"));
  EXPECT_EQ(test::violations("manifest", json), "");
  EXPECT_EQ(test::violations("manifest", canonical), "");
}

TEST(Mixtures, InvalidMixturesAreRejectedAtTheirPlace) {
  const auto said = [](const Json& entry, int particles = 300) { return test::refusal(swept({entry}, particles)); };
  const auto expect = [&](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << "wanted: " << part << "\nsaid: " << text;
  };
  expect(said(mixture({kind("cube", .5), kind("octahedron", .4)})), "the fractions sum to 0.9");
  expect(said(mixture({kind("cube", .5), kind("octahedron", .4)})), "/sweep/solid/0/mixture");
  expect(said(mixture({kind("cube", 1.5)})), "/sweep/solid/0/mixture/0/fraction");
  expect(said(mixture({kind("cube", 1, 0)})), "/sweep/solid/0/mixture/0/size");
  expect(said(mixture({kind("cube", 1, {{"uniform", {2, 1}}})})), "do not ascend");
  expect(said(mixture({kind("cube", 1, {{"gamma", 2}})})), "/sweep/solid/0/mixture/0/size/gamma");
  expect(said(mixture({kind("cube", 1, Json::object())})), "the sizes need exactly one distribution");
  expect(said(mixture({kind("sphere", 1)})), "/sweep/solid/0/mixture/0/solid");
  expect(said(mixture({})), "a list of 1 to 32");
  expect(said(mixture({kind("cube", .999), kind("octahedron", .001)})), "its rarest kind would have no particle");
  expect(said(mixture({kind("cube", .999), kind("octahedron", .001)})), "use at least 1000 particles");
  // One particle in a hundred is ten times as long: N must be so large that the cell is longer than two of its
  // diameters.
  const auto huge = said(mixture({kind("cube", .99), kind("cube", .01, 10)}));
  expect(huge, "is too small for");
  const auto least =
      least_particles(parse(swept({mixture({kind("cube", .99), kind("cube", .01, 10)})}, 20000)).solids[0],
                      JamOptions{}.compression.max_density);
  expect(huge, "use at least " + std::to_string(least));
  auto named = two_sizes;
  named["name"] = "cube";
  expect(said(named), "/sweep/solid/0/name");
  expect(test::refusal(swept({two_sizes, two_sizes})), "/sweep/solid");
  auto one = two_sizes, other = two_shapes;
  one["name"] = other["name"] = "twice";
  expect(test::refusal(swept({one, other})), "two entries have the name twice");
}

TEST(Mixtures, PackingsAreReadWithTheSameBits) {
  for (const auto& entry : {two_sizes, two_shapes, by_law}) {
    const auto manifest = parse(swept({entry}));
    RandomStream random{82};
    const auto packing = random_packing(manifest.solids[0].particles(200), .5, random);
    const auto text = Json::parse(to_json(packing).dump());
    const auto again = read_packing(JsonPlace(text, "p.json"));
    EXPECT_TRUE(again.solids == packing.solids);
    EXPECT_EQ(again.poses, packing.poses);
    EXPECT_EQ(PackingEnergy().evaluate(again).gradient, PackingEnergy().evaluate(packing).gradient);
    auto wrong = text;
    wrong["size"][3] = 2;
    EXPECT_THROW(read_packing(JsonPlace(wrong, "p.json")), InputError) << "volumes have mean 1";
    wrong = text;
    wrong["kind"][3] = 9;
    EXPECT_THROW(read_packing(JsonPlace(wrong, "p.json")), InputError);
  }
}

TEST(Mixtures, AreRecordedDrawnAndExported) {
  const test::TemporaryDirectory directory;
  auto manifest = swept({two_sizes, two_shapes}, 96);
  manifest["replicates"] = 2;
  manifest["measure"] = {"contacts", "order", "clusters", "modes", "moduli", "rigidity"};
  manifest["modes"] = 4;
  test::write_text(directory / "m.json", manifest.dump());
  const auto run = test::isojam({"run", "m.json", "-o", "r"}, directory.path());
  ASSERT_EQ(run.exit_code, 0) << run.err << run.out;
  const auto single = test::isojam({"run", "m.json", "-o", "s", "-j", "1"}, directory.path());
  ASSERT_EQ(single.exit_code, 0) << single.err;
  EXPECT_EQ(test::results_below(directory / "r"), test::results_below(directory / "s"));

  const auto records = test::files_below(directory / "r" / "records");
  const auto shapes = Json::parse(records.at("cube_0.5+tetrahedron_0.5-N96-r0000.json")),
             sizes = Json::parse(records.at("octahedron_0.5+octahedronx1.4_0.5-N96-r0000.json"));
  EXPECT_EQ(test::violations("record", shapes), "");
  EXPECT_EQ(test::violations("record", sizes), "");
  const auto& state = test::nearest_of(shapes);
  const auto& numbers = state.at("contacts");
  EXPECT_EQ(numbers.at("shape_pairs").size(), 3U);
  long contacts = 0;
  for (const auto& pair : numbers.at("shape_pairs")) contacts += pair.at("contacts").get<long>();
  EXPECT_NEAR(2 * static_cast<double>(contacts) / 96, numbers.at("Z").get<double>(), 1e-12);
  EXPECT_NEAR((numbers.at("kind_1").at("Z").get<double>() + numbers.at("kind_2").at("Z").get<double>()) / 2,
              numbers.at("Z").get<double>(), 1e-12);
  EXPECT_TRUE(state.at("order").at("S").is_null());
  EXPECT_FALSE(test::nearest_of(sizes).at("order").at("S").is_null()) << "one shape";
  EXPECT_GT(test::nearest_of(sizes).at("contacts").at("kind_2").at("Z"),
            test::nearest_of(sizes).at("contacts").at("kind_1").at("Z"))
      << "the larger ones touch more";

  const auto table = test::isojam({"aggregate", "r", "--format", "json"}, directory.path());
  ASSERT_EQ(table.exit_code, 0) << table.err;
  const auto rows = Json::parse(table.out).at("rows");
  EXPECT_EQ(rows.size(), 2U);
  for (const auto& row : rows) {
    EXPECT_EQ(row.at("Z_1").at("n"), 2);
    EXPECT_EQ(row.at("Z_2").at("n"), 2);
    EXPECT_FALSE(row.contains("Z_3"));
  }
  EXPECT_EQ(test::violations("tables", Json::parse(table.out)), "");
  for (const auto& command : {std::vector<std::string>{"report", "r"},
                              {"status", "r"},
                              {"export", "r", "all", "--format", "gsd", "-o", "gsd"},
                              {"export", "r", "all", "--format", "vtp", "-o", "vtp"},
                              {"export", "r", "all", "--format", "xyz", "-o", "xyz"}}) {
    const auto done = test::isojam(command, directory.path());
    EXPECT_EQ(done.exit_code, 0) << command.front() << ": " << done.err;
  }
}

}  // namespace
}  // namespace isojam
