#pragma once

#include <cstdint>

#include "tasks/manifest/plan.hpp"

namespace isojam {

/// Estimated cost of a replicate.
struct Cost {
  double cpu_seconds = 0;
  double memory_bytes = 0;  ///< memory that the replicate needs while it runs, without the memory of the program itself
  double disk_bytes = 0;    ///< size of the record, of the packing, and of the path if it is kept
};

/// Estimates the cost of a replicate. The CPU time is a power of N, fitted for each named solid to replicates with the
/// default protocol at N = 100 and 400, on two virtual cores of an AMD EPYC. Other solids and mixtures are treated as
/// cubes. The time of compression is inversely proportional to consolidation_step. The CPU time is accurate to a factor
/// of about two. On another machine or with another protocol, all CPU times change by about the same factor;
/// Survey::calibration is this factor.
Cost estimated_cost(const ReplicateSpec& spec, bool keep_path);

/// Number of replicates that may be in memory at the same time, if each needs at most `largest` bytes and `available`
/// bytes are free. One fifth of the free memory is not used, because `largest` is an estimate. The number is at least
/// 1, and at most `threads`, because more replicates than threads would not be faster. `available` may be infinite.
int replicates_in_flight(int threads, double largest, double available);

}  // namespace isojam
