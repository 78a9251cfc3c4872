#pragma once

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// The field /protocol/by_solid. The sweep must be read before it.
Custom by_solid_field(Manifest& manifest);

/// Sets two parameters if the manifest does not: compression_evaluations of tetrahedra, and max_density of cubes, which
/// becomes densest_compression(). max_density is not set if a particle could then touch two images of another one.
void add_defaults_of_solids(const JsonPlace& root, Manifest& manifest);

/// Density above which cubes always have at least the target energy, plus the length of a strain step. If max_density
/// is this sum, compression can always reach the target energy. N particles of unit volume in a cell of volume N/φ
/// overlap, so the intersections have a total volume of at least N(1 − 1/φ). With z neighbours per particle, E/N is
/// then at least (1 − 1/φ)²/(2z), because E is the sum of V²/4. A cube in a crystal has z = 26 neighbours. The result
/// is never smaller than max_density, and never larger than 2.
double densest_compression(const JamOptions& options);

}  // namespace isojam
