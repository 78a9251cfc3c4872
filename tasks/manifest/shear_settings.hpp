#pragma once

#include "engine/shear/shear.hpp"
#include "tasks/io/place.hpp"

namespace isojam {

/// Reads /shear of a manifest: the settings of the measure `shear`. Throws InputError for unknown keys, for numbers out
/// of range, and for a step that is larger than the final load.
ShearOptions read_shear(const JsonPlace& place);

/// Canonical form of the settings, which contains every value, also defaults.
Json shear_json(const ShearOptions& options);

}  // namespace isojam
