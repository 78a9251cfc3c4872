#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/names/enum_names.hpp"
#include "tasks/io/describe.hpp"

namespace isojam {

/// Comparisons of a chart, in the order in which they are measured.
enum class Comparison { equilibrium, hessian, modes, overlap, atlas };
template <>
inline constexpr std::array enum_names<Comparison>{
    EnumName{Comparison::equilibrium, "equilibrium"}, EnumName{Comparison::hessian, "hessian"},
    EnumName{Comparison::modes, "modes"}, EnumName{Comparison::overlap, "overlap"},
    EnumName{Comparison::atlas, "atlas"}};
inline constexpr auto all_comparisons = all_of<Comparison>;

/// Configuration of a chart. The default values of the members are the default configuration, which takes less than
/// five minutes on a machine with two cores. describe() states the meanings and the allowed values.
struct ChartConfig {
  std::vector<Comparison> compare{all_comparisons.begin(), all_comparisons.end()};
  std::vector<SolidKind> solids{SolidKind::tetrahedron, SolidKind::octahedron};
  std::uint64_t seed = 1;
  int particles = 64;
  int packings = 2;
  std::vector<double> distances{0.1, 0.03, 0.01};
  double fit_window = 0.05;
  std::vector<double> tolerances{1e-3, 1e-6, 1e-9};
  std::vector<double> energy_changes{1e-12};
  std::vector<double> difference_steps{1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-11};
  std::vector<double> shifts{1e-6, 1e-9, 1e-11, 1e-13};
  std::vector<int> subspaces{120, 200};
  int pairs = 40;
  int repetitions = 3;
  long max_evaluations = 4000;
  long rule_evaluations = 20000;  ///< the paper's stopping rule needs more of them
  double point_seconds = 10;
  double total_seconds = 280;
};
void describe(Fields& field, ChartConfig& config);

/// The configuration of a chart that takes an hour. It has larger packings and more settings. It has all Platonic
/// solids except cubes, whose constraints are redundant.
ChartConfig full_chart_config();

/// Reads a configuration. A key that is missing has the default value in ChartConfig. Throws InputError if a key is
/// unknown or occurs twice, or if a value is not allowed. `file` is the name of the configuration in error messages.
ChartConfig parse_chart_config(std::string_view text, const std::string& file);

}  // namespace isojam
