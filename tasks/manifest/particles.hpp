#pragma once

#include <vector>

#include "tasks/json/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Refuses numbers of particles for which a kind of a mixture has no particle, or for which the cell would be too small
/// at the greatest density. The error names the solid that needs most particles. `root`: of the manifest.
void check_particles(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets);

}  // namespace isojam
