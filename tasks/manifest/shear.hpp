#pragma once

#include "engine/shear/shear.hpp"
#include "tasks/json/place.hpp"

namespace isojam {

/// Reads /shear of a manifest: how packings are sheared where that is measured. Throws InputError for unknown keys, for
/// numbers out of range, and for a step beyond its end.
ShearOptions read_shear(const JsonPlace& place);

/// Canonical form: every value spelt out.
Json shear_json(const ShearOptions& options);

}  // namespace isojam
