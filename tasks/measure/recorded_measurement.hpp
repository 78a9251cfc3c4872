#pragma once

#include "tasks/measure/measure.hpp"

namespace isojam {

/// The part of the record of a successful replicate that this measure wrote. Combining the parts of all measures gives
/// the same bytes again.
Measurement recorded_measurement(Measure what, const Json& record);

}  // namespace isojam
