#pragma once

#include "tasks/measure/measure.hpp"

namespace isojam {

/// The part of a record that this measure wrote. The replicate must not have failed. A record that is made from the
/// parts of all measures has the same bytes as the original.
Measurement recorded_measurement(Measure what, const Json& record);

}  // namespace isojam
