#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "engine/geometry/convex_solid.hpp"
#include "engine/names/enum_names.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// Comparisons of a chart, in the order of measurement.
enum class Comparison { equilibrium, hessian, modes, overlap, atlas, phi_j, growth };
template <>
inline constexpr std::array enum_names<Comparison>{EnumName{Comparison::equilibrium, "equilibrium"},
                                                   EnumName{Comparison::hessian, "hessian"},
                                                   EnumName{Comparison::modes, "modes"},
                                                   EnumName{Comparison::overlap, "overlap"},
                                                   EnumName{Comparison::atlas, "atlas"},
                                                   EnumName{Comparison::phi_j, "phi_j"},
                                                   EnumName{Comparison::growth, "growth"}};
inline constexpr auto all_comparisons = all_of<Comparison>;

/// Settings of the protocol. Each is varied alone, starting from the first of its list.
struct PhiJConfig {
  SolidKind solid = SolidKind::octahedron;
  int replicates = 3;
  std::vector<int> particles{64, 50};
  std::vector<double> consolidation_step{0.02, 0.04};
  std::vector<double> target_energy{3.2e-5, 1e-6};
  std::vector<double> fit_window{0.02, 0.05, 0.1};
  std::vector<double> residual{1e-6, 1e-3};
};

/// Sizes over which the growth of costs is measured.
struct GrowthConfig {
  std::vector<SolidKind> solids{SolidKind::octahedron};
  std::vector<int> particles{50, 100, 200};
  int replicates = 2;                                      ///< per solid and size
  std::vector<double> distances{0.05, 0.03, 0.02, 0.012};  ///< Δφ above jamming, of the equilibria that are timed
};

/// Comparisons of a chart and their time limits. The in-class values are the default configuration; it ends within five
/// minutes on a machine with two cores.
struct ChartConfig {
  std::vector<Comparison> compare{all_comparisons.begin(), all_comparisons.end()};
  std::vector<SolidKind> solids{SolidKind::tetrahedron, SolidKind::octahedron};
  std::uint64_t seed = 1;
  int particles = 64;
  int packings = 2;                                  ///< per solid
  std::vector<double> distances{0.1, 0.03, 0.01};    ///< Δφ above jamming, of equilibria to be found
  double fit_window = 0.05;                          ///< states within it give the φ_J by which methods are compared
  std::vector<double> tolerances{1e-3, 1e-6, 1e-9};  ///< residuals requested of every method
  std::vector<double> energy_changes{1e-12};         ///< of the paper's rule
  std::vector<double> difference_steps{1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-11};
  std::vector<double> shifts{1e-6, 1e-9, 1e-11, 1e-13};  ///< −σ/λ_max of shift-invert
  std::vector<int> subspaces{120, 200};                  ///< dimensions of the Krylov spaces
  int pairs = 40;                                        ///< per solid and class of contact
  int repetitions = 3;                                   ///< of timed work
  long max_evaluations = 4000;                           ///< of one minimisation
  /// Evaluations of one minimisation by the paper's rule, which stops late.
  long rule_evaluations = 20000;
  double point_seconds = 10;   ///< of one point, wall clock
  double total_seconds = 280;  ///< after which no further point begins and the current one is stopped
  PhiJConfig phi_j;
  GrowthConfig growth;
};

/// The configuration for an hour: larger packings, and all solids except cubes, whose constraints are redundant.
ChartConfig full_chart_config();

/// Reads a configuration; missing keys have their values of `ChartConfig`. Throws InputError for anything that is not
/// understood, out of range, or given twice.
ChartConfig parse_chart_config(std::string_view text, const std::string& file);

/// The complete configuration, as parse_chart_config() reads it.
Json to_json(const ChartConfig& config);

}  // namespace isojam
