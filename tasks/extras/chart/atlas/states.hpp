#pragma once

#include <stop_token>
#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// States of 45 octahedra, which is the smallest number that is allowed in a cell, decompressed to Δφ = 1.3e-3. The
/// condition numbers of their Hessians range from 1e3 to 6e12.
class AtlasStates {
 public:
  /// Jams the packing. Throws std::runtime_error if this fails, which happens only if the protocol has an error.
  explicit AtlasStates(const std::stop_token& stop = {});

  /// True if there are no states because of a stop request. No other function may then be called.
  bool empty() const { return states_.empty(); }

  double phi_j() const { return phi_j_; }
  /// States of the decompression, in the order of descending density.
  const std::vector<Packing>& all() const { return states_; }
  /// φ − φ_J of one of these states.
  double distance_of(const Packing& packing) const { return packing.density() - phi_j_; }
  /// The state from which one strain step leads to Δφ: the nearest state with a larger Δφ, or the first state.
  const Packing& above(double delta_phi) const;

 private:
  double phi_j_ = 0;
  std::vector<Packing> states_;
};

}  // namespace isojam
