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

/// Estimates the cost of a replicate. The CPU time is the sum of compression, decompression and measures. Each is a
/// power of N and of the parameters that change it most, see cost.cpp. Solids without constants of their own and
/// mixtures are treated as cubes. On another machine or with another protocol, all CPU times of a sweep point change by
/// about the same factor, which surveys_of() finds from the records.
Cost estimated_cost(const ReplicateSpec& spec, bool keep_path);

/// Number of replicates that may be in memory at the same time, if each needs at most `largest` bytes and `available`
/// bytes are free. One fifth of the free memory is not used, because `largest` is an estimate. The number is at least
/// 1, and at most `threads`, because more replicates than threads would not be faster. `available` may be infinite.
int replicates_in_flight(int threads, double largest, double available);

}  // namespace isojam
