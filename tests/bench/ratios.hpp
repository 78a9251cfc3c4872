#pragma once

#include <map>
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

/// A claim and what was measured.
struct Verdict {
  Claim claim;
  double ours = 0, peer = 0;  ///< per unit, as the claim says; ns, or the counter's unit
  double ratio = 0;           ///< as the claim says; of an absolute claim, ours
  bool holds = true;
};

/// All that is claimed, in the order of the table.
std::vector<Claim> all_claims();

/// Median of a list that is not empty.
double median(std::vector<double> values);

/// Of the claims both sides of which were measured.
std::vector<Verdict> judge(const std::vector<Claim>& claims, const std::map<std::string, double>& medians);

}  // namespace isojam::bench
