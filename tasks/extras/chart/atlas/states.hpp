#pragma once

#include <stop_token>
#include <vector>

#include "engine/packing/packing.hpp"

namespace isojam {

/// States of a packing of 45 octahedra, decompressed to Δφ = 1.3e-3. With fewer particles, a particle could touch two
/// images of another one at max_density. The condition numbers of the Hessians of these states are between 1e3 and
/// 6e12.
class AtlasStates {
 public:
  /// Jams the packing. Throws std::runtime_error if no φ_J is found, which would be an error of the protocol.
  explicit AtlasStates(const std::stop_token& stop = {});

  /// True if there are no states because of a stop request. In this case call no other function.
  bool empty() const { return states_.empty(); }

  double phi_j() const { return phi_j_; }
  /// All states of the decompression, in the order of decreasing density.
  const std::vector<Packing>& all() const { return states_; }
  /// φ − φ_J of one of these states.
  double distance_of(const Packing& packing) const { return packing.density() - phi_j_; }
  /// The state before a strain step to Δφ: the nearest one with φ − φ_J > Δφ, or the first state if there is none.
  const Packing& above(double delta_phi) const;

 private:
  double phi_j_ = 0;
  std::vector<Packing> states_;
};

}  // namespace isojam
