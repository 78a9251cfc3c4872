#pragma once

#include <map>
#include <string>
#include <vector>

namespace isojam::bench {

/// A claim about two measured quantities, `ours` and `peer`. A quantity is the median time of a benchmark in ns, with
/// the name `family/method/case`. It can also be a counter of a benchmark, with the name `family/method/case#counter`.
struct Claim {
  enum class Kind {
    faster,   ///< claims that peer / ours ≥ bound
    costs,    ///< claims that ours / peer ≤ bound
    absolute  ///< claims that ours ≤ bound
  };
  Kind kind = Kind::faster;
  std::string ours, peer;
  double bound = 0;  ///< 0: nothing is claimed, and the ratio is only printed
  /// The quantities are divided by these numbers first. With numbers of particles, the claim is about the cost per
  /// particle.
  double ours_per = 1, peer_per = 1;
};

/// A claim with its measured values.
struct Verdict {
  Claim claim;
  double ours = 0, peer = 0;  ///< values of the quantities after the division, in ns or in the unit of the counter
  /// ratio that the claim compares with the bound; for an absolute claim, the value of `ours`
  double ratio = 0;
  bool holds = true;
};

/// All claims, in the order in which they are printed.
std::vector<Claim> all_claims();

/// Median of a list with at least one value.
double median(std::vector<double> values);

/// Verdicts on the claims for which both quantities were measured.
std::vector<Verdict> judge(const std::vector<Claim>& claims, const std::map<std::string, double>& medians);

}  // namespace isojam::bench
