// Facts proved here:
// - the plan is the product of the swept lists, in canonical order, each replicate once and under a name of its own,
//   which says what varies, can be that of a file, and leads back to the replicate;
// - a replicate's random numbers do not depend on what else is swept over, nor on its place in the sweep;
// - they differ between replicates, points, seeds and purposes.

#include "tasks/manifest/plan.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

std::vector<ReplicateSpec> plan_of(const Json& manifest) {
  return test::make_plan(parse_manifest(manifest.dump(), "m"));
}

Json large_sweep() {
  auto manifest = test::good_manifest();
  manifest["sweep"]["solid"] = {"octahedron", "cube", "tetrahedron"};
  manifest["sweep"]["particles"] = {200, 100};
  manifest["sweep"]["target_energy"] = {1e-5, 1e-6};
  manifest["sweep"]["method"] = {"lbfgs", "conjugate_gradient"};
  manifest["replicates"] = 3;
  return manifest;
}

std::vector<std::uint64_t> first_bits(const ReplicateSpec& spec, Purpose purpose = Purpose::placement) {
  auto stream = replicate_stream(spec, purpose);
  std::vector<std::uint64_t> bits;
  for (int i = 0; i < 4; ++i) bits.push_back(stream.bits());
  return bits;
}

TEST(Plan, IsTheProductOfTheListsInOrder) {
  const auto plan = plan_of(large_sweep());
  ASSERT_EQ(plan.size(), 3U * 2 * 2 * 2 * 3);
  std::set<std::string> names;
  std::vector<std::tuple<SolidKind, int, Json, int>> keys;
  for (const auto& spec : plan) {
    names.insert(replicate_name(spec));
    keys.emplace_back(spec.solid, spec.particles, spec.parameters, spec.replicate);
    EXPECT_EQ(spec.options.target_energy, spec.parameters.at("target_energy").get<double>());
    EXPECT_EQ(to_string(spec.options.minimise.method), spec.parameters.at("method").get<std::string>());
  }
  EXPECT_EQ(names.size(), plan.size());
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
}

TEST(Plan, NamesSayWhatTheyAre) {
  const auto plan = plan_of(test::good_manifest());
  EXPECT_EQ(replicate_name(plan.at(1)), "dodecahedron-N64-r0001");
  EXPECT_EQ(replicate_name(plan_of(large_sweep()).front()),
            "tetrahedron-N100-method_conjugate_gradient-target_energy1e-06-r0000");
  auto manifest = test::good_manifest();
  manifest["sweep"]["final_distance"] = {0.01};
  EXPECT_EQ(replicate_name(plan_of(manifest).at(1)), "dodecahedron-N64-final_distance0.01-r0001");
}

TEST(Plan, NamesAreSafeAndLeadBack) {
  auto manifest = large_sweep();
  manifest["sweep"]["residual"] = {1e-6, 1.2345678901234567e-9, 1};
  manifest["sweep"]["target_before_relaxation"] = {false, true};
  for (const bool longer : {false, true}) {
    if (longer) manifest["sweep"]["consolidation_evaluations"] = {100, 123456789};
    const Plan plan(parse_manifest(manifest.dump(), "m"));
    std::set<std::string> names;
    std::size_t hashed = 0;
    for (std::size_t k = 0; k < plan.size(); ++k) {
      const auto name = replicate_name(plan[k]);
      names.insert(name);
      EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyzN0123456789.-_"), std::string::npos) << name;
      EXPECT_LE(name.size(), 102U) << name;
      hashed += name.find("-method_") == std::string::npos;
      const auto place = plan.place_of(name);
      ASSERT_TRUE(place) << name;
      EXPECT_EQ(place->point * 3 + static_cast<std::size_t>(place->replicate), k) << name;
    }
    EXPECT_EQ(names.size(), plan.size());
    // What would be too long to read has a hash in the place of what varies.
    EXPECT_GT(hashed, 0U);
    EXPECT_EQ(hashed == plan.size(), longer);
  }
}

TEST(Plan, AReplicateDrawsTheSameBitsInEverySweep) {
  std::map<std::string, std::vector<std::uint64_t>> in_large;
  for (const auto& spec : plan_of(large_sweep())) in_large[replicate_name(spec)] = first_bits(spec);

  auto small = large_sweep();
  small["sweep"]["solid"] = {"octahedron"};
  small["sweep"]["particles"] = {100};
  small["sweep"]["target_energy"] = {1e-6};
  small["sweep"]["method"] = {"conjugate_gradient"};
  small["protocol"]["max_steps"] = 17;
  small["replicates"] = 2;
  const auto plan = plan_of(small);
  ASSERT_EQ(plan.size(), 2U);
  for (const auto& spec : plan) {
    ASSERT_TRUE(in_large.contains(replicate_name(spec))) << replicate_name(spec);
    EXPECT_EQ(in_large.at(replicate_name(spec)), first_bits(spec)) << replicate_name(spec);
  }
}

TEST(Plan, StreamsDiffer) {
  std::set<std::vector<std::uint64_t>> seen;
  std::size_t drawn = 0;
  for (const int seed : {7, 8}) {
    auto manifest = large_sweep();
    manifest["seed"] = seed;
    for (const auto& spec : plan_of(manifest)) {
      for (const auto purpose : {Purpose::placement, Purpose::bootstrap}) {
        seen.insert(first_bits(spec, purpose));
        ++drawn;
      }
    }
  }
  EXPECT_EQ(seen.size(), drawn);
}

}  // namespace
}  // namespace isojam
