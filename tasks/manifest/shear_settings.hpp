#pragma once

#include "engine/shear/shear.hpp"
#include "tasks/io/place.hpp"

namespace isojam {

/// Reads /shear of a manifest: the settings of the measure `shear`. Throws InputError if a key is unknown, if a value
/// is not allowed, or if the number of steps (`until` divided by `step`) is less than 1 or more than 10000.
ShearOptions read_shear(const JsonPlace& place);

/// All settings, including defaults, as a JSON object.
Json shear_json(const ShearOptions& options);

}  // namespace isojam
