#include "tasks/extras/chart/config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/packing/cell/periodic_cell.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/parse.hpp"

namespace isojam {
namespace {

/// Reports an error if the cell would be too small at the highest density that the compression may reach.
void check_particles(const JsonPlace& root, const ChartConfig& config, SolidKind solid) {
  const int least = least_particles(platonic(solid), JamOptions().compression.max_density);
  if (config.particles >= least) return;
  const JsonPlace place = root.has("particles") ? root.at("particles") : root;
  root.attempt([&] {
    place.refuse_with_remedy(fmt::format("{} is too small for {}", config.particles, to_string(solid)),
                             fmt::format("use at least {} particles", least));
  });
}

}  // namespace

void describe(Fields& field, ChartConfig& config) {
  constexpr Range few{1, 1000}, distances{1e-3, 0.2}, tolerances{0, 1, true}, evaluations{10, 1e7},
      seconds{0, 1e6, true};
  field.type("", "Methods to compare, their parameters, and time limits.");
  const auto number = [&](const char* key, auto& value, const Range& range, const char* meaning) -> FieldEntry& {
    return field(key, value, meaning).range(range).finite().optional();
  };
  const auto list = [&](const char* key, auto& values, const Range& range, const char* meaning) {
    number(key, values, range, meaning).length(1).distinct();
  };
  field
      .custom("$schema",
              {[] { return Json(); }, [](const JsonPlace& place) { place.text(); }, {{"type", "string"}}, "text"},
              "Path or address of this schema. Editors use it to check the configuration.")
      .optional();
  list("compare", config.compare, {}, "Comparisons to make, in this order.");
  list("solids", config.solids, {}, "Solids of every comparison.");
  number("seed", config.seed, count_range, "Seed of the packings.");
  number("particles", config.particles, {8, 2000}, "Number of particles per packing.");
  number("packings", config.packings, few, "Number of packings per solid.");
  list("distances", config.distances, distances, "Distances to jamming Δφ of the equilibria to be found.");
  number("fit_window", config.fit_window, distances,
         "Distance to jamming Δφ below which states are used to fit the jamming density of each minimiser.");
  list("tolerances", config.tolerances, tolerances, "Residuals requested of every minimiser.");
  list("energy_changes", config.energy_changes, tolerances,
       "Relative energy changes at which conjugate gradients stop under the paper's stopping rule.");
  list("difference_steps", config.difference_steps, tolerances, "Steps of the central differences.");
  list("shifts", config.shifts, tolerances,
       "Negative shifts of the shift-invert method, divided by the largest eigenvalue.");
  list("subspaces", config.subspaces, {60, 1000}, "Dimensions of the Krylov spaces.");
  number("pairs", config.pairs, {1, 1e5}, "Number of pairs for each solid and contact class.");
  number("repetitions", config.repetitions, few,
         "Number of repetitions of each timing. Work longer than a tenth of a second is timed once.");
  number("max_evaluations", config.max_evaluations, evaluations,
         "Largest number of evaluations in one minimisation that does not use the paper's stopping rule.");
  number("rule_evaluations", config.rule_evaluations, evaluations,
         "Largest number of evaluations in one minimisation that uses the paper's stopping rule.");
  number("point_seconds", config.point_seconds, seconds, "Largest wall-clock time of one minimisation.").unit("s");
  number("total_seconds", config.total_seconds, seconds,
         "Wall-clock time after which the chart is written, even if measurements are missing.")
      .unit("s");
}

ChartConfig full_chart_config() {
  ChartConfig config;
  config.solids = {SolidKind::tetrahedron, SolidKind::octahedron, SolidKind::dodecahedron, SolidKind::icosahedron};
  config.particles = 100;
  config.packings = 3;
  config.distances = {0.1, 0.06, 0.04, 0.025, 0.015, 0.01, 0.007};
  config.tolerances = {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-9};
  config.energy_changes = {1e-10, 1e-12, 1e-14};
  config.difference_steps = {1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13};
  config.shifts = {1e-3, 1e-6, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12, 1e-13, 1e-14};
  config.subspaces = {80, 120, 200, 300};
  config.pairs = 300;
  config.max_evaluations = 20000;
  config.rule_evaluations = 100000;
  config.point_seconds = 30;
  config.total_seconds = 3500;
  return config;
}

ChartConfig parse_chart_config(std::string_view text, const std::string& file) {
  const Json document = parse_json(text, file);
  Problems problems;
  const JsonPlace root(document, file, "", &problems);
  ChartConfig config;
  root.attempt([&] { read_into(root, config); });
  problems.refuse_any(document);
  for (const SolidKind solid : config.solids) check_particles(root, config, solid);
  problems.refuse_any(document);
  return config;
}

}  // namespace isojam
