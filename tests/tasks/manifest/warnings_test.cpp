#include "tasks/manifest/warnings.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <set>

#include "tests/tasks/support/bad_manifests.hpp"
#include "tests/tasks/support/support.hpp"

namespace isojam {
namespace {

using Lines = std::vector<std::string>;

/// Pointers of the warnings about a manifest with all solids and these changes.
Lines warned(const Json& changes) {
  auto manifest = test::good_manifest();
  manifest["sweep"]["solid"] = {"tetrahedron", "cube", "octahedron", "dodecahedron", "icosahedron"};
  manifest["sweep"]["particles"] = {150};
  manifest.merge_patch(changes);
  auto lines = warnings_of(parse_manifest(manifest.dump(), "m.json"));
  for (auto& line : lines) {
    std::printf("%s\n", line.c_str());
    line = line.substr(0, line.find(':'));
  }
  return lines;
}

Lines of_protocol(const Json& values) { return warned({{"protocol", values}}); }
Lines of_minimiser(const Json& values) { return warned({{"minimiser", values}}); }

TEST(Warnings, DefaultsAndExamplesHaveNone) {
  EXPECT_EQ(warned(Json::object()), Lines{});
  int seen = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(ISOJAM_SOURCE_DIR "/examples")) {
    if (entry.path().extension() != ".json" || entry.path().parent_path().filename() == "data") continue;
    ++seen;
    // These use too few evaluations on purpose.
    const bool hasty = std::set<std::string>{"protocol", "compression-start", "compression-tetrahedra"}.contains(
        entry.path().stem().string());
    EXPECT_EQ(warnings_of(read_manifest(entry.path().string())).size(), hasty ? 1 : 0) << entry.path();
  }
  EXPECT_GT(seen, 10);
}

TEST(Warnings, TheFitWindowMustHoldTwoStates) {
  EXPECT_EQ(of_protocol({{"final_distance", 0.05}}), Lines{"/protocol/final_distance"});
  EXPECT_EQ(of_protocol({{"final_distance", 0.02}}), Lines{"/protocol/final_distance"});
  // The state before the last one is up to .015 / (1 - .35) = .023 above jamming.
  EXPECT_EQ(of_protocol({{"final_distance", 0.015}}), Lines{"/protocol/fit_window"});
  EXPECT_EQ(of_protocol({{"final_distance", 0.012}}), Lines{});
  EXPECT_EQ(of_protocol({{"final_distance", 0.015}, {"longest_step", 0.004}}), Lines{});
  EXPECT_EQ(warned({{"sweep", {{"final_distance", {0.001, 0.03, 0.04}}}}}), Lines{"/sweep/final_distance"});
}

TEST(Warnings, DensitiesMustReachBeyondJamming) {
  const Lines each(5, "/protocol/max_density");
  EXPECT_EQ(of_protocol({{"max_density", 0.6}}), each);
  EXPECT_EQ(of_protocol({{"max_density", 0.7}}), each) << "above jamming, but without the target energy";
  EXPECT_EQ(of_protocol({{"max_density", 0.82}}), each) << "at which most octahedra have not got there";
  EXPECT_EQ(of_protocol({{"max_density", 0.91}}), Lines{});
  const Json gentle{{"max_density", 0.76}, {"target_before_relaxation", true}};
  EXPECT_EQ(of_protocol(gentle), Lines{}) << "compression ends just above jamming";
  EXPECT_EQ(of_protocol({{"max_density", 0.5}, {"target_before_relaxation", true}}), each);
  EXPECT_EQ(of_protocol({{"max_steps", 15}}), Lines(5, "/protocol/max_steps"));
  EXPECT_EQ(of_protocol({{"max_steps", 15}, {"compression_step", 0.08}}), Lines{});
  EXPECT_EQ(warned({{"sweep", {{"solid", {"cube"}}, {"max_density", {0.5, 0.6, 0.93}}}}}), Lines{"/sweep/max_density"});
}

TEST(Warnings, EnergiesMustAllowADecompression) {
  const Lines each(5, "/protocol/target_energy");
  EXPECT_EQ(of_protocol({{"target_energy", 1e-16}}), each);
  EXPECT_EQ(of_protocol({{"target_energy", 1e-9}}), Lines{});
}

TEST(Warnings, MinimisersMustReachTheResidual) {
  EXPECT_EQ(of_minimiser({{"method", "lbfgs"}}), Lines{"/minimiser/method"});
  // With the paper's rule, states are not balanced. By default, such replicates are excluded from the means.
  const Json papers{{"method", "lbfgs"}, {"energy_change", 1e-12}};
  EXPECT_EQ(of_minimiser(papers), Lines{"/minimiser/energy_change"});
  EXPECT_EQ(warned({{"minimiser", papers}, {"exclude", {"crystalline"}}}), Lines{});
  EXPECT_EQ(of_minimiser({{"method", "lbfgs"}, {"residual", 1e-3}}), Lines{});
  EXPECT_EQ(of_protocol({{"compression_evaluations", 100}}), Lines{"/protocol/compression_evaluations"});
  EXPECT_EQ(warned({{"sweep", {{"solid", {"cube"}}}}, {"protocol", {{"compression_evaluations", 100}}}}), Lines{});
}

TEST(Warnings, FreeCellsNeedMoreParticles) {
  const auto of_free_cell = [](const char* solid, int particles) {
    return warned({{"sweep", {{"solid", {solid}}, {"particles", {particles}}}}, {"protocol", {{"cell", "free"}}}});
  };
  for (const auto& [solid, enough] : {std::pair{"octahedron", 65}, {"tetrahedron", 91}, {"cube", 100}}) {
    EXPECT_EQ(of_free_cell(solid, enough - 1), Lines{"/protocol/cell"}) << solid;
    EXPECT_EQ(of_free_cell(solid, enough), Lines{}) << solid;
  }
}

TEST(Warnings, KeysWithoutEffect) {
  const Json shear{{"mode", "simple"}};
  EXPECT_EQ(warned({{"shear", shear}}), Lines{"/shear"});
  EXPECT_EQ(warned({{"shear", shear}, {"measure", {"shear"}}}), Lines{});
  EXPECT_EQ(warned({{"modes", 20}, {"measure", {"contacts"}}}), Lines{"/modes"});
  EXPECT_EQ(warned({{"modes", 20}, {"measure", {"backbone"}}}), Lines{});
  EXPECT_EQ(warned({{"exclude", {"not_stable"}}, {"measure", {"contacts"}}}), Lines{"/exclude"});
  EXPECT_EQ(warned({{"exclude", {"not_stable"}}, {"measure", {"modes"}}}), Lines{});
  const Json cohesion{{"range", 0.2}, {"until", "end"}};
  EXPECT_EQ(of_protocol({{"cohesion", cohesion}}), (Lines{"/protocol/cohesion/range", "/protocol/cohesion/until"}));
  const Json box{{"brick", {{"box", {1, 1, 2}}}}};
  EXPECT_EQ(warned({{"solids", box}}), Lines{"/solids/brick"});
  EXPECT_EQ(warned({{"solids", box}, {"sweep", {{"solid", {"brick"}}}}}), Lines{});
}

TEST(Warnings, AStoppingRuleNeedsTheSpreadOfEnoughReplicates) {
  const auto of_goal = [](int min, int max) {
    return warned({{"replicates", {{"min", min}, {"max", max}, {"quantity", "phi_j"}, {"half_width", 0.01}}}});
  };
  EXPECT_EQ(of_goal(2, 40), Lines{"/replicates/min"});
  EXPECT_EQ(of_goal(7, 40), Lines{"/replicates/min"});
  EXPECT_EQ(of_goal(8, 40), Lines{});
  EXPECT_EQ(of_goal(4, 4), Lines{}) << "nothing is chosen";
  EXPECT_EQ(warned({{"replicates", 4}}), Lines{});
}

}  // namespace
}  // namespace isojam
