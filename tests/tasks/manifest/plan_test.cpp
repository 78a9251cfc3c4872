#include "tasks/manifest/plan.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <tuple>

#include "tasks/records/replicate.hpp"
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
  manifest["sweep"]["method"] = {"lbfgs", "newton"};
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
  std::vector<std::tuple<Mixture, int, Json, int>> keys;
  for (const auto& spec : plan) {
    names.insert(replicate_name(spec));
    keys.emplace_back(spec.solid, spec.particles, spec.parameters, spec.replicate);
    EXPECT_EQ(spec.options.compression.target_energy, spec.parameters.at("target_energy").get<double>());
    EXPECT_EQ(to_string(spec.options.minimise.method), spec.parameters.at("method").get<std::string>());
  }
  EXPECT_EQ(names.size(), plan.size());
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
}

TEST(Plan, NamesStateWhatVaries) {
  const auto plan = plan_of(test::good_manifest());
  EXPECT_EQ(replicate_name(plan.at(1)), "dodecahedron-N64-r0001");
  EXPECT_EQ(replicate_name(plan_of(large_sweep()).front()), "tetrahedron-N100-method_lbfgs-target_energy1e-06-r0000");
  auto manifest = test::good_manifest();
  manifest["sweep"]["final_distance"] = {0.01};
  EXPECT_EQ(replicate_name(plan_of(manifest).at(1)), "dodecahedron-N64-final_distance0.01-r0001");
}

TEST(Plan, NamesAreFileNamesAndLeadBack) {
  auto manifest = large_sweep();
  manifest["sweep"]["residual"] = {1e-6, 1.2345678901234567e-9, 1};
  manifest["sweep"]["target_before_relaxation"] = {false, true};
  for (const bool longer : {false, true}) {
    if (longer) manifest["sweep"]["compression_evaluations"] = {100, 123456789};
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
      EXPECT_EQ(plan.digest(*place), spec_digest(plan[k])) << name;
    }
    EXPECT_EQ(names.size(), plan.size());
    // A name that would be too long contains a hash instead of its parameters.
    EXPECT_GT(hashed, 0U);
    EXPECT_EQ(hashed == plan.size(), longer);
  }
}

/// The parts of a specification that determine the random numbers.
using Origin = std::tuple<std::uint64_t, Mixture, int, int>;
Origin origin_of(const ReplicateSpec& spec) { return {spec.seed, spec.solid, spec.particles, spec.replicate}; }

TEST(Plan, StreamsDifferOnlyByOriginAndPurpose) {
  std::map<std::pair<Origin, Purpose>, std::set<std::vector<std::uint64_t>>> drawn;
  std::set<std::vector<std::uint64_t>> seen;
  for (const int seed : {7, 8}) {
    auto manifest = large_sweep();
    manifest["seed"] = seed;
    for (const auto& spec : plan_of(manifest)) {
      for (const auto purpose : {Purpose::placement, Purpose::bootstrap}) {
        const auto bits = first_bits(spec, purpose);
        drawn[{origin_of(spec), purpose}].insert(bits);
        seen.insert(bits);
      }
    }
  }
  EXPECT_EQ(drawn.size(), 2U * 3 * 2 * 3 * 2);
  for (const auto& [key, bits] : drawn) EXPECT_EQ(bits.size(), 1U) << "one of a number at every swept parameter";
  EXPECT_EQ(seen.size(), drawn.size());
}

Packing start_of(const ReplicateSpec& spec) { return engine_stages().begin(spec).progress.packing; }

/// A value other than the default.
Json another_value(const Parameter& parameter) {
  const auto usual = written(parameter.field);
  if (usual.is_boolean()) return !usual.get<bool>();
  if (usual == "density") return "pressure";
  if (usual == "isotropic") return "free";
  if (usual == "decompression") return "end";
  if (usual.is_string()) return "lbfgs";
  if (usual.is_number_integer()) return usual.get<long>() + 1;
  return usual.get<double>() / 2 + 1e-9;
}

TEST(Plan, ReplicatesOfOneNumberHaveTheSameInitialConfiguration) {
  const auto alone = plan_of(test::good_manifest());
  // Two values of each parameter, one parameter at a time. The product of all would have half a million replicates.
  for (const auto& parameter : all_parameters()) {
    const auto& name = parameter.name;
    const bool strained = name == "initial_density";
    auto manifest = test::good_manifest();
    manifest["sweep"][name] = Json{written(parameter.field), another_value(parameter)};
    const auto plan = plan_of(manifest);
    ASSERT_EQ(plan.size(), 4U) << name;
    for (const auto& spec : plan) {
      const auto start = start_of(spec), expected = start_of(alone.at(static_cast<std::size_t>(spec.replicate)));
      ASSERT_EQ(start.size(), expected.size());
      const double stretch = start.cell.side() / expected.cell.side();
      EXPECT_TRUE(strained || stretch == 1) << name;
      for (std::size_t i = 0; i < start.poses.size(); ++i) {
        const auto& pose = start.poses[i];
        EXPECT_LE((pose.position - stretch * expected.poses[i].position).norm(), strained ? 1e-12 : 0) << name;
        EXPECT_EQ(pose.orientation.coeffs(), expected.poses[i].orientation.coeffs()) << name;
      }
    }
  }
}

/// The first random bits of replicates in a sweep over solids and N only. They must not change between versions.
TEST(Plan, TheBitsOfPlainSweepsDoNotChange) {
  const auto spec = plan_of(test::good_manifest()).at(1);
  RandomStream stream{7, hash_of(R"({"solid":"dodecahedron","particles":64})"), 1,
                      static_cast<std::uint64_t>(Purpose::placement)};
  for (const auto bits : first_bits(spec)) EXPECT_EQ(bits, stream.bits());
}

}  // namespace
}  // namespace isojam
