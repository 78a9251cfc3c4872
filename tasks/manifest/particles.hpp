#pragma once

#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Density near which packings reach the default target energy.
inline constexpr double compressed_density = 0.82;

/// Checks the numbers of particles, and throws InputError if a number is too small. There are two cases: a kind of a
/// mixture would have no particle, or the cell would be so small that a particle could touch two images of another one.
/// The second check is made for the cell at the largest max_density of `sets`. The error names a mixture in the first
/// case, and in the second case the solid or mixture that needs the most particles. `root` is the whole manifest.
void check_particles(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets);

}  // namespace isojam
