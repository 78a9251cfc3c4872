#pragma once

#include <optional>
#include <span>

#include "engine/packing/mixture/mixture.hpp"
#include "tasks/io/json.hpp"

namespace isojam {

/// Critical angles and random curves of a solid, as in the paper's Figure 2. They do not depend on a run. Angles are in
/// degrees:
///  {"critical": {"face_face": [{"topology", "angle"}], "edge_face": [...]},
///   "random": [{"which", "face_face": [[θ, c], ...], "edge_face": [...]}]}.
/// For a mixture, it has the smallest critical angles and no random curves.
Json angle_references(const Mixture& mixture);

/// Empirical distribution of angles (radians, in any order) as [[θ in degrees, c], ...], with one entry for each step.
/// If several steps are so close in log θ that a diagram does not resolve them, only the last one is kept. Angles below
/// `angle_floor` are replaced by `angle_floor`.
Json thinned_cdf(std::span<const double> angles);

/// Smallest angle that is drawn, in degrees.
inline constexpr double angle_floor = 1e-6;

/// Jamming density of the paper's Table I, with the half width of its 95 % confidence interval.
struct PaperDensity {
  double phi_j = 0, half_width = 0;
};
/// The value for a packing of the paper; nullopt for all other packings.
std::optional<PaperDensity> paper_density(const Mixture& solid, int particles);

}  // namespace isojam
