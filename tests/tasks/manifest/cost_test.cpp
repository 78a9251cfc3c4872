// Properties tested here:
// - For twelve studies of the examples, the estimated CPU time is within a factor of 1.5 of the measured one.
// - More of everything that takes time costs more: particles, distance, compression, measures, shear, a free cell.
// - More packings and longer records take more disk space.

#include "tasks/manifest/cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam {
namespace {

const std::string examples = ISOJAM_SOURCE_DIR "/examples/";

/// CPU time of the stages that the manifest requests. Other measures were added later.
double measured_seconds(const Json& replicate, const ReplicateSpec& spec) {
  if (!replicate.contains("stages")) return replicate.at("cpu");
  const auto& stages = replicate.at("stages");
  double seconds = stages.at("jam");
  for (const auto measure : spec.measures) {
    const std::string name(to_string(measure));
    if (stages.contains(name)) seconds += stages.at(name).get<double>();
  }
  return seconds;
}

bool is_of(const Json& replicate, const ReplicateSpec& spec) {
  if (replicate.at("solid") != to_string(spec.solid) || replicate.at("particles") != spec.particles) return false;
  if (!replicate.contains("setting")) return true;
  const auto& setting = replicate.at("setting");
  const auto& compression = spec.options.compression;
  return setting.at("before") == compression.target_before_relaxation && setting.at("step") == compression.step &&
         setting.at("budget") == compression.evaluations;
}

struct Study {
  const char *manifest, *data, *name;
};

TEST(Cost, AgreesWithTwelveStudies) {
  for (const auto& [manifest, data, name] :
       {Study{"paper/n100", "paper/data/records", "paper-100"},
        Study{"paper/n100-tetrahedra", "paper/data/records", "paper-100-tetrahedra"},
        Study{"paper/n400", "paper/data/records", "paper-400"},
        Study{"paper/n400-tetrahedra", "paper/data/records", "paper-400-tetrahedra"},
        Study{"paper/cubes", "paper/data/records", "paper-cubes"},
        Study{"paper/rule-base", "paper/data/records", "paper-rule-base"},
        Study{"paper/search-protocol", "paper/data/search", "paper-search-protocol"},
        Study{"paper/search-400", "paper/data/search", "paper-search-400"},
        Study{"rigidity/n50", "rigidity/data/records", "rigidity-50"},
        Study{"rigidity/n50-tetrahedra", "rigidity/data/records", "rigidity-50-tetrahedra"},
        Study{"rigidity/n200", "rigidity/data/records", "rigidity-200"},
        Study{"rigidity/n800", "rigidity/data/records", "rigidity-800"}}) {
    const Plan plan(read_manifest(examples + manifest + ".json"));
    const auto file = examples + data + ".json";
    const auto study = parse_json(read_file(file), file).at(name);
    double measured = 0, estimated = 0;
    for (const auto& replicate : study.is_object() ? study.at("replicates") : study) {
      if (replicate.at("status") != "done") continue;
      for (std::size_t point = 0; point < plan.points(); ++point) {
        const auto spec = plan.at(point, 0);
        if (!is_of(replicate, spec)) continue;
        measured += measured_seconds(replicate, spec);
        estimated += estimated_cost(spec, false).cpu_seconds;
      }
    }
    std::printf("| `%s.json` | %.0f | %.0f | %.2f |\n", manifest, measured, estimated, estimated / measured);
    EXPECT_GT(measured, 0) << name;
    EXPECT_LT(std::max(estimated / measured, measured / estimated), 1.5) << name;
  }
}

double seconds_of(const Json& changes) {
  auto manifest = test::good_manifest();
  manifest["sweep"] = {{"solid", {"octahedron"}}, {"particles", {100}}};
  manifest.erase("protocol");
  manifest.merge_patch(changes);
  return estimated_cost(Plan(parse_manifest(manifest.dump(), "m")).at(0, 0), false).cpu_seconds;
}

TEST(Cost, GrowsWithEverythingThatTakesTime) {
  const double usual = seconds_of(Json::object());
  for (const Json& more :
       {Json{{"sweep", {{"particles", {200}}}}}, Json{{"protocol", {{"final_distance", 0.001}}}},
        Json{{"protocol", {{"consolidation_step", 0.01}}}}, Json{{"protocol", {{"step_fraction", 0.1}}}},
        Json{{"protocol", {{"consolidation_evaluations", 4000}}}}, Json{{"protocol", {{"cell", "free"}}}},
        Json{{"measure", {"contacts", "order", "clusters", "backbone"}}},
        Json{{"measure", {"contacts", "order", "clusters", "shear"}}}}) {
    EXPECT_GT(seconds_of(more), 1.1 * usual) << more;
  }
  const Json sheared{{"measure", {"shear"}}};
  auto back = sheared;
  back["shear"] = {{"back", true}};
  EXPECT_GT(seconds_of(back), seconds_of(sheared));
}

}  // namespace
}  // namespace isojam
