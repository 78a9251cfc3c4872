#pragma once

#include <benchmark/benchmark.h>

#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam::bench {

/// Random packings with density 0.7 after a few evaluations with L-BFGS. Their contacts are similar to those of a
/// compressed packing, but such packings can be computed even for 10⁴ particles. Later calls with the same arguments
/// return the same object.
const std::vector<Packing>& relaxed(SolidKind kind, int n, int packings = 1);

/// An equilibrium of 100 or more particles whose density is about φ_J + `distance`. Later calls with the same arguments
/// return the same object.
const Packing& jammed(SolidKind kind, int n, double distance);

/// The counter that shows the time of a benchmark divided by the number of things that all its iterations handled.
inline benchmark::Counter seconds_per(double things) {
  return {things, benchmark::Counter::kIsRate | benchmark::Counter::kInvert};
}

}  // namespace isojam::bench
