#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/names/enum_names.hpp"
#include "tasks/io/json.hpp"

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
/// five minutes on a machine with two cores.
struct ChartConfig {
  std::vector<Comparison> compare{all_comparisons.begin(), all_comparisons.end()};
  std::vector<SolidKind> solids{SolidKind::tetrahedron, SolidKind::octahedron};
  std::uint64_t seed = 1;
  int particles = 64;
  int packings = 2;                                ///< number of packings of each solid
  std::vector<double> distances{0.1, 0.03, 0.01};  ///< distances Δφ of the equilibria that are compared
  double fit_window = 0.05;  ///< in the family `bias`, φ_J is fitted to states with Δφ below this value
  /// residuals that every minimiser has to reach; with the paper's stopping rule, energy_changes applies instead
  std::vector<double> tolerances{1e-3, 1e-6, 1e-9};
  /// relative energy changes at which the paper's stopping rule ends a minimisation
  std::vector<double> energy_changes{1e-12};
  /// steps of central differences
  std::vector<double> difference_steps{1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-11};
  std::vector<double> shifts{1e-6, 1e-9, 1e-11, 1e-13};  ///< shifts σ as −σ/λ_max, with the largest eigenvalue λ_max
  std::vector<int> subspaces{120, 200};                  ///< dimensions of the Krylov space of Lanczos methods
  int pairs = 40;                                        ///< number of pairs for each solid and class of pairs
  int repetitions = 3;                                   ///< largest number of repetitions of a measurement of time
  long max_evaluations = 4000;                           ///< largest number of evaluations in one minimisation
  /// largest number of evaluations in one minimisation with the paper's stopping rule, which needs more of them
  long rule_evaluations = 20000;
  double point_seconds = 10;   ///< wall-clock time after which a minimisation is stopped
  double total_seconds = 280;  ///< wall-clock time after which the chart is stopped
};

/// The configuration of a chart that takes an hour. It has larger packings and more settings. It has all Platonic
/// solids except cubes, whose constraints are redundant.
ChartConfig full_chart_config();

/// Reads a configuration. A key that is missing has the default value in ChartConfig. Throws InputError if a key is
/// unknown or occurs twice, or if a value is not allowed. `file` is the name of the configuration in error messages.
ChartConfig parse_chart_config(std::string_view text, const std::string& file);

/// All values of a configuration, in the format that parse_chart_config() reads.
Json to_json(const ChartConfig& config);

}  // namespace isojam
