#pragma once

#include <vector>

#include "tasks/json/place.hpp"
#include "tasks/manifest/manifest.hpp"

namespace isojam {

/// Refuses numbers of particles for which a kind of a mixture has none, or whose cell would be illegal at the greatest
/// of all densities, by the solid that needs most. `root`: of the manifest.
void check_particles(const JsonPlace& root, const Manifest& manifest, const std::vector<OptionSet>& sets);

}  // namespace isojam
