#pragma once

#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// The field /protocol/by_solid. The sweep must be read before it.
Custom by_solid_field(Manifest& manifest);

/// Notes whether max_density of cubes is given, and sets the compression of tetrahedra if the manifest does not.
void add_defaults_of_solids(const JsonPlace& root, Manifest& manifest);

/// The default of max_density for cubes: they order during compression, and a crystal can exceed the usual limit long
/// before it has the target energy. It is the density above which cubes always have at least the target energy, plus
/// half of a strain step, so that compression can always reach the target energy. (In a cell that is too small for this
/// density, the default is the largest density that is possible.) N particles of unit volume in a cell of volume N/φ
/// overlap, so the intersections have a total volume of at least N(1 − 1/φ). With z neighbours per particle, E/N is
/// then at least (1 − 1/φ)²/(2z), because E is the sum of V²/4. A cube in a crystal has z = 26 neighbours. The result
/// is never smaller than max_density, and never larger than 2.
double densest_compression(const JamOptions& options);

}  // namespace isojam
