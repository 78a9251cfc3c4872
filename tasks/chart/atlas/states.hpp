#pragma once

#include <stop_token>
#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// 45 octahedra, the fewest in a legal cell, expanded to Δφ = 1.3e-3: condition numbers from 1e3 to 6e12.
class AtlasStates {
 public:
  /// Jams them. Throws std::runtime_error if this fails, which it does only if the protocol is broken.
  explicit AtlasStates(const std::stop_token& stop = {});

  /// True if a stop request left no states; no other function may be called then.
  bool empty() const { return states_.empty(); }

  double phi_j() const { return phi_j_; }
  /// States of the expansion, density descending.
  const std::vector<Packing>& all() const { return states_; }
  /// φ − φ_J of one of these states.
  double distance_of(const Packing& packing) const { return packing.density() - phi_j_; }
  /// The state from which one strain step leads to Δφ: the nearest of those above, or the first.
  const Packing& above(double delta_phi) const;

 private:
  double phi_j_ = 0;
  std::vector<Packing> states_;
};

}  // namespace isojam
