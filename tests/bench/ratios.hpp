#pragma once

#include <string>
#include <vector>

namespace isojam::bench {

/// What is said of two measured quantities, and printed with the word that it holds or not. A quantity is the median
/// time of a benchmark, named `family/method/case`, in ns, or one of its counters, named `family/method/case#counter`.
struct Claim {
  enum class Kind {
    faster,   ///< peer / ours ≥ bound
    costs,    ///< ours / peer ≤ bound
    absolute  ///< ours ≤ bound
  };
  Kind kind = Kind::faster;
  std::string ours, peer;
  double bound = 0;  ///< 0: the ratio is shown and nothing is asked of it
  /// Each quantity is divided by its own: the number of particles, where the cost of one is compared.
  double ours_per = 1, peer_per = 1;
};

/// All that is claimed, in the order of the table.
std::vector<Claim> all_claims();

}  // namespace isojam::bench
