#pragma once

#include <vector>

#include "tasks/io/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Throws InputError if a number of particles is too small: a kind of a mixture would have no particle, or the cell at
/// the largest density would be so small that a particle could touch two images of another one. The error names the
/// solid that needs most particles. `root` is the whole manifest.
void check_particles(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets);

}  // namespace isojam
