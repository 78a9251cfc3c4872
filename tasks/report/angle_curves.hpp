#pragma once

#include <optional>
#include <span>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/json/json.hpp"

namespace isojam {

/// What Figure 2 of the paper draws for a solid whatever was run. Angles in degrees:
///   {"critical": {"face_face": [{"topology", "angle"}], "edge_face": [...]},
///    "random": [{"which", "face_face": [[θ, c], ...], "edge_face": [...]}]}.
/// Of a mixture the least critical angles, and no random ones.
Json angle_references(const Mixture& mixture);

/// Empirical CDF of angles (radians, any order) as [[θ in degrees, c], ...], one entry for each step, or, where steps
/// lie closer in log θ than a chart resolves, the last of them. Angles below `angle_floor` degrees stand at it.
Json thinned_cdf(std::span<const double> angles);

/// Least angle drawn, degrees.
inline constexpr double angle_floor = 1e-6;

/// Jamming density of the paper's Table I, with the half width of its 95 % interval.
struct PaperDensity {
  double phi_j = 0, half_width = 0;
};
/// nullopt for what the paper does not have.
std::optional<PaperDensity> paper_density(const Mixture& solid, int particles);

}  // namespace isojam
