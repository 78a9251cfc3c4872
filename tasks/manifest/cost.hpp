#pragma once

#include <cstdint>

#include "tasks/manifest/plan.hpp"

namespace isojam {

/// What a replicate is expected to take.
struct Cost {
  double cpu_seconds = 0;
  double memory_bytes = 0;  ///< while it runs, beyond what the program takes anyway
  double disk_bytes = 0;    ///< record, packing, and the path where it is kept
};

/// The cost of a replicate, from replicates measured with the default protocol at N = 100 and 400 (two virtual cores of
/// an AMD EPYC): a power of N for each solid, and the share of consolidation, which grows as its steps shrink. Right to
/// a factor of two or so; another machine or protocol shifts all of them alike, which what is recorded already can
/// tell.
Cost estimated_cost(const ReplicateSpec& spec, bool keep_path);

/// Bytes that this process may still take without driving the machine, or the control group that it is in, out of
/// memory. 0 if that cannot be told.
double available_memory();

/// How many replicates of at most `largest` bytes each may be in memory at once: no more than threads, since more
/// would not be faster, and at least one.
int replicates_in_flight(int threads, double largest, double available);

}  // namespace isojam
