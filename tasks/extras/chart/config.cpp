#include "tasks/extras/chart/config.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/packing/cell/periodic_cell.hpp"
#include "engine/solve/jam.hpp"
#include "tasks/io/options.hpp"
#include "tasks/io/parse.hpp"

namespace isojam {
namespace {

constexpr Range seed_range{0, 9007199254740992};  // 2^53: every JSON reader represents smaller integers exactly
constexpr Range few_range{1, 1000};
constexpr Range particle_range{8, 2000};
constexpr Range distance_range{1e-3, 0.2};
constexpr Range tolerance_range{0, 1, true};
constexpr Range subspace_range{60, 1000};
constexpr Range evaluation_range{10, 1e7};
constexpr Range second_range{0, 1e6, true};

/// Visits every field with its key and range. One list serves for reading and writing, so the two cannot differ.
template <class Config, class Visitor>
void visit_chart(Config& config, const Visitor& visit) {
  visit("compare", config.compare, Range{});
  visit("solids", config.solids, Range{});
  visit("seed", config.seed, seed_range);
  visit("particles", config.particles, particle_range);
  visit("packings", config.packings, few_range);
  visit("distances", config.distances, distance_range);
  visit("fit_window", config.fit_window, distance_range);
  visit("tolerances", config.tolerances, tolerance_range);
  visit("energy_changes", config.energy_changes, tolerance_range);
  visit("difference_steps", config.difference_steps, tolerance_range);
  visit("shifts", config.shifts, tolerance_range);
  visit("subspaces", config.subspaces, subspace_range);
  visit("pairs", config.pairs, Range{1, 1e5});
  visit("repetitions", config.repetitions, few_range);
  visit("max_evaluations", config.max_evaluations, evaluation_range);
  visit("rule_evaluations", config.rule_evaluations, evaluation_range);
  visit("point_seconds", config.point_seconds, second_range);
  visit("total_seconds", config.total_seconds, second_range);
}

void read_keys(const JsonPlace& root, ChartConfig& config) {
  std::vector<std::string_view> keys{"$schema"};
  visit_chart(config, [&](std::string_view key, const auto&, const Range&) { keys.push_back(key); });
  root.expect_keys(keys);
  root.read_if_any("$schema", [](const JsonPlace& place) { place.text(); });
  visit_chart(config, [&](const std::string& key, auto& value, const Range& range) {
    root.read_if_any(key, [&](const JsonPlace& place) { read_option(place, range, value); });
  });
}

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
  root.attempt([&] { read_keys(root, config); });
  problems.refuse_any(document);
  for (const SolidKind solid : config.solids) check_particles(root, config, solid);
  problems.refuse_any(document);
  return config;
}

Json to_json(const ChartConfig& config) {
  Json json = Json::object();
  visit_chart(config, [&](const std::string& key, const auto& value, const Range&) { json[key] = option_json(value); });
  return json;
}

}  // namespace isojam
