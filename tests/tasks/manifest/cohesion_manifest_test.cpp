#include <gtest/gtest.h>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/manifest/warnings.hpp"
#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

Manifest parse(const Json& manifest) { return parse_manifest(manifest.dump(), "m.json"); }

Json with_cohesion(const Json& cohesion) {
  auto manifest = test::good_manifest();
  manifest["protocol"]["cohesion"] = cohesion;
  return manifest;
}

TEST(CohesionManifest, HasTheStrengthZeroByDefault) {
  const auto plain = parse(test::good_manifest());
  EXPECT_EQ(to_json(parse(with_cohesion({{"strength", 0}}))), to_json(plain));
  EXPECT_NE(to_json(parse(with_cohesion({{"strength", 1e-5}}))), to_json(plain));
}

TEST(CohesionManifest, IsWhole) {
  const auto manifest = parse(with_cohesion({{"strength", 1e-5}, {"until", "end"}}));
  const Json expected{{"strength", 1e-5}, {"range", 0.1}, {"until", "end"}};
  EXPECT_EQ(to_json(manifest).at("protocol").at("cohesion"), expected);
  EXPECT_EQ(to_json(test::make_plan(manifest).front()).at("protocol").at("cohesion"), expected);
  EXPECT_EQ(to_json(parse(to_json(manifest))).dump(), to_json(manifest).dump());
  EXPECT_TRUE(ends_at_zero_pressure(manifest.protocol));
}

TEST(CohesionManifest, CanBeSwept) {
  auto json = with_cohesion({{"until", "end"}, {"range", 0.05}});
  json["sweep"]["cohesion.strength"] = {1e-4, 0, 1e-5};
  const auto manifest = parse(json);
  EXPECT_EQ(to_json(parse(to_json(manifest))).dump(), to_json(manifest).dump());
  const auto plan = test::make_plan(manifest);
  ASSERT_EQ(plan.size(), 6U);
  for (const auto& spec : plan) {
    const double strength = spec.parameters.at("cohesion.strength").get<double>();
    EXPECT_EQ(spec.options.cohesion, (Cohesion{0.05, strength}));
    EXPECT_EQ(ends_at_zero_pressure(spec.options), strength > 0);
  }
  EXPECT_EQ(replicate_name(plan.back()), "dodecahedron-N64-cohesion.strength0.0001-r0001");
}

TEST(CohesionManifest, WarnsOfWhatHasNoEffect) {
  const auto none = warnings_of(parse(with_cohesion({{"range", 0.2}, {"until", "end"}})));
  ASSERT_EQ(none.size(), 2U);
  EXPECT_EQ(none[0], "/protocol/cohesion/range: has no effect, because the strength of the cohesion is 0");
  EXPECT_TRUE(warnings_of(parse(with_cohesion({{"strength", 1e-5}, {"range", 0.05}}))).empty());
}

TEST(CohesionManifest, IsTheSameForAllSolids) {
  auto manifest = test::good_manifest();
  manifest["protocol"]["by_solid"]["dodecahedron"]["cohesion"] = {{"strength", 1e-4}};
  try {
    parse(manifest);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(error.details().pointer, "/protocol/by_solid/dodecahedron/cohesion");
    EXPECT_NE(std::string(error.what()).find("did you mean \"/protocol/cohesion\"?"), std::string::npos);
  }
}

}  // namespace
}  // namespace isojam
