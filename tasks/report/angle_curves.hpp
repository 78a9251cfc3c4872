#pragma once

#include <optional>
#include <span>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// Curves of the paper's Figure 2 for a solid, which do not depend on the run. Angles in degrees:
///  {"critical": {"face_face": [{"topology", "angle"}], "edge_face": [...]},
///   "random": [{"which", "face_face": [[θ, c], ...], "edge_face": [...]}]}.
/// For a mixture: the smallest critical angles, and no random curves.
Json angle_references(const Mixture& mixture);

/// Empirical CDF of angles (radians, any order) as [[θ in degrees, c], ...], one entry for each step. If steps are
/// closer in log θ than a chart resolves, only the last is kept. Angles below `angle_floor` degrees are moved to it.
Json thinned_cdf(std::span<const double> angles);

/// Least angle drawn, degrees.
inline constexpr double angle_floor = 1e-6;

/// Jamming density of the paper's Table I, with the half width of its 95 % confidence interval.
struct PaperDensity {
  double phi_j = 0, half_width = 0;
};
/// nullopt for packings that are not in the paper.
std::optional<PaperDensity> paper_density(const Mixture& solid, int particles);

}  // namespace isojam
