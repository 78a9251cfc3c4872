#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// Participation ratio p = (Σ_i |u_i|²)² / (N Σ_i |u_i|⁴), u_i the six entries of particle i: 1 if all particles move
/// equally, 1/N if only one moves. A mode has 6N entries, which must not all be 0.
double participation_ratio(const Eigen::Ref<const Eigen::VectorXd>& mode);
/// Participation ratios of all modes, in their order.
Eigen::VectorXd participation_ratios(const ModeSet& modes);

/// Mean frequency ⟨ω⟩ of a set of modes, ω = √λ in V_p^(-1/3)·√(Y/ρ), as in the paper's Fig. 1(b): ⟨ω_l⟩ of the lowest
/// modes, ⟨ω_h⟩ of the highest. nullopt if the set is empty or some λ is not above `tolerance`, because such a mode has
/// no frequency.
std::optional<double> mean_frequency(const ModeSet& modes, double tolerance);

/// Amplitude of modes on a subset of the particles.
struct AmplitudeShare {
  double amplitude = 0;  ///< Σ |u_i|² over the marked particles, mean over the modes
  double particles = 0;  ///< fraction of particles that are marked: the value of `amplitude` for uniform modes
};
/// Amplitude on the `marked` particles; one entry per particle, nonzero if marked, for example those with a face-face
/// contact. nullopt without modes.
std::optional<AmplitudeShare> amplitude_share(const ModeSet& modes, std::span<const char> marked);

/// Density of states as a function of log10 ω, for the modes with λ above a tolerance.
struct DensityOfStates {
  Eigen::VectorXd edges;       ///< edges of the bins, log10 ω, ascending; bins + 1 entries
  Eigen::VectorXd density;     ///< fraction of all modes per unit of log10 ω
  Eigen::VectorXd cumulative;  ///< fraction of all modes below each edge, including modes without a frequency
  int without_frequency = 0;   ///< number of modes with λ up to the tolerance
};
/// Density of states in `bins` of equal width from the lowest to the highest frequency. nullopt if bins < 1 or all
/// frequencies are equal. All modes (dense_modes) give that of the packing.
std::optional<DensityOfStates> density_of_states(const Eigen::VectorXd& eigenvalues, double tolerance, int bins = 24);

}  // namespace isojam
