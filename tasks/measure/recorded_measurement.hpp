#pragma once

#include "tasks/measure/measure.hpp"

namespace isojam {

/// What a measure has written into the record of a replicate that did not fail and for which it was made: joined with
/// those of the other measures again, it gives the same bytes.
Measurement recorded_measurement(Measure what, const Json& record);

}  // namespace isojam
