#include "tasks/manifest/cost.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "tasks/io/file.hpp"
#include "tasks/io/parse.hpp"
#include "tests/tasks/support/bad_manifests.hpp"

namespace isojam {
namespace {

/// CPU times of recorded replicates: for each manifest, a list of objects with the solid, the number of particles, the
/// swept parameters, the number of replicates, and the sum of their times.
const std::string measured_file = ISOJAM_SOURCE_DIR "/tests/tasks/manifest/data/measured_costs.json";

double estimated_seconds(const Plan& plan, const Json& measured) {
  for (std::size_t point = 0; point < plan.points(); ++point) {
    const auto spec = plan.at(point, 0);
    if (to_string(spec.solid) == measured.at("solid").get<std::string>() &&
        spec.particles == measured.at("particles").get<int>() && spec.parameters == measured.at("parameters"))
      return measured.at("replicates").get<double>() * estimated_cost(spec, false).cpu_seconds;
  }
  ADD_FAILURE() << "no sweep point is " << measured;
  return 0;
}

TEST(Cost, AgreesWithStudiesOfTheExamples) {
  const auto studies = parse_json(read_file(measured_file), measured_file);
  EXPECT_EQ(studies.size(), 20);
  for (const auto& study : studies.items()) {
    const Plan plan(read_manifest(ISOJAM_SOURCE_DIR "/examples/" + study.key()));
    double measured = 0, estimated = 0;
    for (const auto& point : study.value()) {
      measured += point.at("seconds").get<double>();
      estimated += estimated_seconds(plan, point);
    }
    std::printf("| `%s` | %.0f | %.0f | %.2f |\n", study.key().c_str(), measured, estimated, estimated / measured);
    EXPECT_LT(std::max(estimated / measured, measured / estimated), 1.5) << study.key();
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
        Json{{"protocol", {{"compression_step", 0.01}}}}, Json{{"protocol", {{"step_fraction", 0.1}}}},
        Json{{"protocol", {{"compression_evaluations", 4000}}}}, Json{{"protocol", {{"cell", "free"}}}},
        Json{{"protocol", {{"cycles", 1}}}}, Json{{"protocol", {{"cohesion", {{"strength", 1e-5}}}}}},
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
