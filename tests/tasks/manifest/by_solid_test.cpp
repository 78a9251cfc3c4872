#include "tasks/manifest/by_solid.hpp"

#include <gtest/gtest.h>

#include <cstdio>

#include "tasks/manifest/plan.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

Json manifest_of(const Json& solids, const Json& protocol, int particles = 150) {
  auto manifest = test::good_manifest();
  manifest["sweep"] = {{"solid", solids}, {"particles", {particles}}};
  manifest["protocol"] = protocol;
  return manifest;
}

Manifest parsed(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

double limit_of(const Manifest& manifest, std::size_t point) {
  return Plan(manifest).at(point, 0).options.compression.max_density;
}

TEST(BySolid, ReachesOnlyItsSolid) {
  const Json own{{"octahedron", {{"max_density", 1.05}, {"final_distance", 0.01}}}};
  const auto manifest = parsed(manifest_of({"dodecahedron", "octahedron"}, {{"by_solid", own}}));
  const Plan plan(manifest);
  const auto octahedra = plan.at(0, 0).options, dodecahedra = plan.at(1, 0).options;
  EXPECT_EQ(dodecahedra.compression.max_density, JamOptions{}.compression.max_density);
  EXPECT_EQ(octahedra.compression.max_density, 1.05);
  EXPECT_EQ(octahedra.decompression.final_distance, 0.01);
  EXPECT_EQ(octahedra.compression.step, JamOptions{}.compression.step);
  EXPECT_EQ(to_json(manifest).at("protocol").at("by_solid"), own);
  EXPECT_EQ(to_json(parsed(to_json(manifest))), to_json(manifest));
  const auto without = parsed(manifest_of({"dodecahedron", "octahedron"}, Json::object()));
  EXPECT_FALSE(to_json(without).at("protocol").contains("by_solid"));
  EXPECT_NE(to_json(without), to_json(manifest));
}

TEST(BySolid, CubesHaveALimitAboveThatOfCrystals) {
  const Json both{"cube", "octahedron"};
  const auto manifest = parsed(manifest_of(both, Json::object()));
  EXPECT_EQ(limit_of(manifest, 0), 1.07);
  EXPECT_EQ(limit_of(manifest, 1), 0.93);
  EXPECT_EQ(to_json(parsed(to_json(manifest))), to_json(manifest));
  const auto raised = parsed(manifest_of(both, {{"target_energy", 1e-3}}));
  EXPECT_GT(limit_of(raised, 0), 1.2);
  for (const auto& given : {parsed(manifest_of(both, {{"max_density", 0.93}})),
                            parsed(manifest_of(both, {{"by_solid", {{"cube", {{"max_density", 0.93}}}}}}))}) {
    EXPECT_EQ(limit_of(given, 0), 0.93);
  }
  auto swept = manifest_of(both, Json::object());
  swept["sweep"]["max_density"] = {0.9, 0.93};
  EXPECT_EQ(limit_of(parsed(swept), 1), 0.93);
}

TEST(BySolid, DefaultsFollowFromTheShape) {
  auto manifest = manifest_of({"cube", "box", "corners", "tetrahedron", "simplex", "brick"}, Json::object());
  const Json corners{{0, 0, 0}, {4, 3, 0}, {-3, 4, 0}, {1, 7, 0}, {0, 0, 5}, {4, 3, 5}, {-3, 4, 5}, {1, 7, 5}};
  manifest["solids"] = {{"box", {{"box", {2, 2, 2}}}},
                        {"corners", {{"vertices", corners}}},
                        {"simplex", {{"vertices", {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}}}},
                        {"brick", {{"box", {1, 1, 2}}}}};
  const auto read = parsed(manifest);
  const Plan plan(read);
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto spec = plan.at(point, 0);
    const auto name = std::string(to_string(spec.solid));
    const auto& compression = spec.options.compression;
    std::printf("%s: max_density %g, %d evaluations\n", name.c_str(), compression.max_density, compression.evaluations);
    const bool cube = name == "cube" || name == "box" || name == "corners";
    EXPECT_EQ(compression.max_density, cube ? 1.07 : 0.93) << name;
    EXPECT_EQ(compression.evaluations, name == "tetrahedron" || name == "simplex" ? 2000 : 200) << name;
  }
  EXPECT_EQ(to_json(parsed(to_json(read))), to_json(read));
}

TEST(BySolid, TheLimitOfCubesDependsOnNothingElseInTheSweep) {
  auto sweep = manifest_of({"cube"}, Json::object());
  sweep["sweep"]["particles"] = {39, 44, 150};
  sweep["sweep"]["target_energy"] = {1e-5, 1e-3};
  const auto manifest = parsed(sweep);
  EXPECT_EQ(to_json(parsed(to_json(manifest))), to_json(manifest));
  const Plan plan(manifest);
  std::vector<double> limits;
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto spec = plan.at(point, 0);
    limits.push_back(spec.options.compression.max_density);
    auto alone = manifest_of({"cube"}, {{"target_energy", spec.parameters.at("target_energy")}}, spec.particles);
    EXPECT_EQ(limit_of(parsed(alone), 0), limits.back()) << point;
  }
  EXPECT_EQ(limits, (std::vector{0.93, 0.93, 1.05, 1.05, limits[4], limits[5]})) << "the cells of 39 and 44 are small";
  EXPECT_LT(limits[4], limits[5]);
}

TEST(BySolid, TetrahedraAreCompressedMoreSlowly) {
  const auto evaluations = [](const Manifest& manifest, std::size_t point) {
    return Plan(manifest).at(point, 0).options.compression.evaluations;
  };
  const Json both{"tetrahedron", "octahedron"};
  const std::string key = "compression_evaluations";
  const auto manifest = parsed(manifest_of(both, Json::object()));
  EXPECT_EQ(evaluations(manifest, 0), 2000);
  EXPECT_EQ(evaluations(manifest, 1), JamOptions{}.compression.evaluations);
  EXPECT_EQ(Plan(manifest).at(0, 0).options.compression.step, 0.02);
  EXPECT_EQ(Plan(manifest).at(1, 0).options.compression.step, JamOptions{}.compression.step);
  EXPECT_EQ(to_json(parsed(to_json(manifest))), to_json(manifest));
  for (const auto& given : {parsed(manifest_of(both, {{key, 700}})),
                            parsed(manifest_of(both, {{"by_solid", {{"tetrahedron", {{key, 700}}}}}}))})
    EXPECT_EQ(evaluations(given, 0), 700);
  auto swept = manifest_of(both, Json::object());
  swept["sweep"][key] = {100, 200};
  EXPECT_EQ(evaluations(parsed(swept), 1), 200);
}

TEST(BySolid, RefusesWhatHasNoMeaning) {
  const auto by_solid = [](const Json& values) { return manifest_of({"octahedron"}, {{"by_solid", values}}); };
  const Json limit{{"max_density", 1.05}};
  EXPECT_NE(test::refusal(by_solid({{"octahedrons", limit}})).find("did you mean \"octahedron\""), std::string::npos);
  EXPECT_NE(
      test::refusal(by_solid({{"cube", limit}})).find("/cube: cube is not in /sweep/solid; add it there, or remove"),
      std::string::npos);
  EXPECT_NE(test::refusal(by_solid({{"octahedron", {{"max_densty", 1}}}})).find("did you mean \"max_density\""),
            std::string::npos);
  EXPECT_NE(
      test::refusal(by_solid({{"octahedron", {{"max_density", 3}}}})).find("/protocol/by_solid/octahedron/max_density"),
      std::string::npos);
  EXPECT_NE(
      test::refusal(by_solid({{"octahedron", {{"max_density", 0.04}}}})).find("initial_density 0.05 is not below"),
      std::string::npos);
  auto swept = by_solid({{"octahedron", limit}});
  swept["sweep"]["max_density"] = {0.9, 0.93};
  EXPECT_NE(test::refusal(swept).find("the parameter is also swept"), std::string::npos);
}

}  // namespace
}  // namespace isojam
