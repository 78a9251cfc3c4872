#pragma once

#include "engine/shear/shear.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// Reads /shear of a manifest: the load for the measure `shear`. Throws InputError for unknown keys, for numbers out of
/// range, and for a step larger than the final load.
ShearOptions read_shear(const JsonPlace& place);

/// Canonical form: every value spelt out.
Json shear_json(const ShearOptions& options);

}  // namespace isojam
