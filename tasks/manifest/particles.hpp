#pragma once

#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Checks the numbers of particles. A number is too small if a kind of a mixture would have no particle. It is also too
/// small if a particle could touch two images of another one in the cell at the largest max_density of `sets`. For too
/// small numbers, throws InputError. The error names the solid or mixture that needs the most particles, or whose
/// rarest kind would have no particle. `root` is the whole manifest.
void check_particles(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets);

}  // namespace isojam
