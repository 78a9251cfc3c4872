#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "tasks/io/input_error.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam {
namespace {

using Lines = std::vector<std::string>;
using test::good_manifest;

/// Error lines for a text. Empty if the text is accepted.
Lines refusals(const std::string& text) {
  try {
    parse_manifest(text, "m.json");
    return {};
  } catch (const InputError& error) {
    Lines lines;
    std::istringstream all(error.what());
    for (std::string line; std::getline(all, line);) lines.push_back(line);
    return lines;
  }
}

/// Only the pointers of these lines.
Lines pointers(const std::string& text) {
  auto lines = refusals(text);
  for (auto& line : lines) {
    line = line.substr(std::string("m.json: ").size());
    line = line.substr(0, line.find(':'));
  }
  return lines;
}

TEST(Refusals, AreReportedAtOnceInTheOrderOfTheDocument) {
  const std::string text = R"({
    "sweep": {"particles": [64, 0, "x", 64], "solid": ["octahedra", "cube"], "final_distance": [2]},
    "seed": -1,
    "protocol": {"target_enery": 1, "approach": 0.3, "step_fraction": 1, "final_distance": 0.01},
    "measure": ["contact", "order"],
    "replicates": {"min": 1, "max": 0, "quantity": "phi_i"},
    "modes": 0,
    "method": "newton"
  })";
  EXPECT_EQ(pointers(text),
            (Lines{"/name", "/sweep/particles/1", "/sweep/particles/2", "/sweep/particles/3", "/sweep/solid/0",
                   "/sweep/final_distance/0", "/seed", "/protocol/target_enery", "/protocol/approach",
                   "/protocol/step_fraction", "/protocol/final_distance", "/measure/0", "/replicates/half_width",
                   "/replicates/min", "/replicates/max", "/replicates/quantity", "/modes", "/method"}));
  EXPECT_EQ(refusals(text).at(4), "m.json: /sweep/solid/0: unknown solid \"octahedra\"; did you mean \"octahedron\"?");
  EXPECT_EQ(refusals(text).at(6), "m.json: /seed: -1 is not accepted; expected an integer from 0 to 9007199254740992");
  auto sphere = good_manifest();
  sphere["sweep"]["solid"] = {"sphere"};
  EXPECT_EQ(
      refusals(sphere.dump()).at(0),
      "m.json: /sweep/solid/0: unknown solid \"sphere\"; expected one of \"tetrahedron\", \"cube\", \"octahedron\", "
      "\"dodecahedron\", \"icosahedron\", \"truncated_tetrahedron\", \"cuboctahedron\", \"rhombic_dodecahedron\", "
      "\"truncated_octahedron\", \"truncated_cube\", prism3, prism5 to prism64, antiprism4 to antiprism48, or a name "
      "defined in /solids");
}

TEST(Refusals, ConsequencesOfOtherErrorsAreNotReported) {
  const auto changed = [](const std::string& from, const std::string& to) {
    auto text = good_manifest().dump();
    return text.replace(text.find(from), from.size(), to);
  };
  EXPECT_EQ(pointers(changed("\"replicates\"", "\"replicate\"")), Lines{"/replicate"}) << "nor is it missing";
  EXPECT_EQ(pointers(changed("\"solid\"", "\"solids\"")), Lines{"/sweep/solids"});
  EXPECT_EQ(pointers(changed("[64]", "[\"64\"]")), Lines{"/sweep/particles/0"}) << "nor is the list empty";
  EXPECT_EQ(pointers(changed("{\"solid\":[\"dodecahedron\"],\"particles\":[64]}", "7")), Lines{"/sweep"});
  auto both = good_manifest();
  both["sweep"]["approach"] = {0.3};
  EXPECT_EQ(pointers(both.dump()), Lines{"/sweep/approach"}) << "renamed, and so not unknown";
  auto goal = good_manifest();
  goal["replicates"] = {{"min", 2}, {"max", 4}, {"quantity", "omega_l"}, {"half_width", 1}};
  goal["measure"] = {"mode"};
  EXPECT_EQ(pointers(goal.dump()), Lines{"/measure/0"}) << "whether it is measured is not known yet";
  goal["measure"] = {"order"};
  EXPECT_EQ(pointers(goal.dump()), Lines{"/replicates/quantity"});
}

TEST(Refusals, ConditionsBetweenValuesNeedValidValues) {
  auto manifest = good_manifest();
  manifest["sweep"]["particles"] = {64, 5, 3};
  manifest["protocol"] = {{"initial_density", 0.95}, {"max_steps", 0}};
  EXPECT_EQ(pointers(manifest.dump()), Lines{"/protocol/max_steps"});
  manifest["protocol"].erase("max_steps");
  EXPECT_EQ(pointers(manifest.dump()),
            (Lines{"/sweep/particles/1", "/sweep/particles/2", "/protocol/initial_density"}));
}

TEST(Refusals, ConditionsBetweenValuesAreReportedWithOtherErrors) {
  auto manifest = good_manifest();
  manifest["protocol"] = {{"cohesion", {{"strength", 1e-4}, {"until", "end"}}}, {"target_before_relaxation", true}};
  manifest["measure"] = {"contacts", "modes", "shear", "moduli"};
  manifest["replicates"] = {{"min", 9}, {"max", 8}, {"quantity", "phi_j"}, {"half_width", 1}};
  manifest["shear"] = {{"step", 0.1}};
  manifest["modes"] = 0;
  EXPECT_EQ(pointers(manifest.dump()),
            (Lines{"/replicates/max", "/replicates/quantity", "/protocol/target_before_relaxation", "/measure/1",
                   "/measure/2", "/measure/3", "/shear/step", "/modes"}));
}

TEST(Refusals, CommentsAreReportedAsComments) {
  const auto good = good_manifest().dump();
  for (const std::string comment : {"// sweep\n", "/* sweep */", "# sweep\n"}) {
    EXPECT_EQ(refusals("{\n  " + comment + good.substr(1)),
              Lines{"m.json:2:3: JSON has no comments; remove the comment"});
    EXPECT_EQ(refusals(good + "\n" + comment), Lines{"m.json:2:1: JSON has no comments; remove the comment"});
  }
  EXPECT_EQ(refusals("{\"seed\": 7, // why\n}").front().rfind("m.json:1:13: ", 0), 0U);
  for (const std::string other : {"{\"seed\": /7}", "{\"seed\": \"\\#\"}", "{\"seed\": \"\n//\"}"})
    EXPECT_NE(refusals(other).at(0).find("not valid JSON"), std::string::npos) << other;
  auto manifest = good_manifest();
  manifest["$schema"] = "https://example.org/#/* x */";
  EXPECT_EQ(refusals(manifest.dump()), Lines{});
}

TEST(Refusals, TooFewParticlesNameAValidDensity) {
  int tried = 0;
  for (const auto kind : all_solids) {
    auto manifest = good_manifest();
    manifest["sweep"]["solid"] = {std::string(to_string(kind))};
    for (int particles = 1;; ++particles) {
      manifest["protocol"] = {{"initial_density", 0.001}};
      manifest["sweep"]["particles"] = {particles};
      const auto lines = refusals(manifest.dump());
      if (lines.empty()) break;
      const std::string says = " particles or set max_density to ";
      const auto found = lines.at(0).find(says);
      if (found == std::string::npos) continue;  // a packing would not reach the target energy at so low a density
      const double density = std::strtod(lines.at(0).c_str() + found + says.size(), nullptr);
      manifest["protocol"]["max_density"] = density;
      EXPECT_EQ(refusals(manifest.dump()), Lines{}) << to_string(kind) << " " << particles << " at " << density;
      EXPECT_GT(density, .8);
      manifest["protocol"]["max_density"] = density + 1e-4;
      EXPECT_NE(refusals(manifest.dump()), Lines{}) << to_string(kind) << " " << particles << " above " << density;
      ++tried;
    }
  }
  std::printf("%d numbers of particles\n", tried);
  EXPECT_GT(tried, 20);
}

TEST(Refusals, TheSolidThatNeedsMostIsNamed) {
  auto manifest = good_manifest();
  manifest["sweep"]["solid"] = {"dodecahedron", "tetrahedron", "cube"};
  manifest["sweep"]["max_density"] = {0.8, 1.2, 0.9};
  manifest["sweep"]["particles"] = {5};
  const auto line = refusals(manifest.dump()).at(0);
  EXPECT_NE(line.find("5 is too small for tetrahedron at max_density 1.2; use at least "), std::string::npos) << line;
  const int least = std::atoi(line.c_str() + line.find("at least ") + 9);
  manifest["sweep"]["particles"] = {least};
  EXPECT_EQ(refusals(manifest.dump()), Lines{}) << line;
  manifest["sweep"]["particles"] = {least - 1};
  EXPECT_NE(refusals(manifest.dump()), Lines{}) << line;
}

}  // namespace
}  // namespace isojam
