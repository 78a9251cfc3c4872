#pragma once

#include <map>
#include <string>
#include <vector>

namespace isojam::bench {

/// A claim about two measured quantities, which is printed with a word that states whether it holds. A quantity is the
/// median time of a benchmark, named `family/method/case`, in ns, or one of its counters, named
/// `family/method/case#counter`.
struct Claim {
  enum class Kind {
    faster,   ///< peer / ours ≥ bound
    costs,    ///< ours / peer ≤ bound
    absolute  ///< ours ≤ bound
  };
  Kind kind = Kind::faster;
  std::string ours, peer;
  double bound = 0;  ///< 0: the ratio is only shown
  /// Divisors of the two quantities: numbers of particles, to compare the cost of one.
  double ours_per = 1, peer_per = 1;
};

/// A claim and the measured values.
struct Verdict {
  Claim claim;
  double ours = 0, peer = 0;  ///< per unit of the claim; ns, or the counter's unit
  double ratio = 0;           ///< as defined by the claim; for an absolute claim, ours
  bool holds = true;
};

/// All claims, in the order of the table.
std::vector<Claim> all_claims();

/// Median of a list, which must not be empty.
double median(std::vector<double> values);

/// Verdicts for the claims of which both sides were measured.
std::vector<Verdict> judge(const std::vector<Claim>& claims, const std::map<std::string, double>& medians);

}  // namespace isojam::bench
