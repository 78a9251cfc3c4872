#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// Participation ratio p = (Σ_i |u_i|²)² / (N Σ_i |u_i|⁴) of a mode, where u_i contains the six entries of particle i.
/// It is 1 if all particles have the same amplitude, and 1/N if only one particle moves. A mode has 6N entries, which
/// must not all be 0.
double participation_ratio(const Eigen::Ref<const Eigen::VectorXd>& mode);
/// Participation ratios of all modes, in the order of the modes.
Eigen::VectorXd participation_ratios(const ModeSet& modes);

/// Mean frequency ⟨ω⟩ of a set of modes, with ω = √λ in units of V_p^(-1/3)·√(Y/ρ). In the paper's Fig. 1(b) it is
/// ⟨ω_l⟩ for the lowest modes and ⟨ω_h⟩ for the highest ones. nullopt if the set is empty, or if some λ is not above
/// `tolerance`, because such a mode has no frequency.
std::optional<double> mean_frequency(const ModeSet& modes, double tolerance);

/// Share of modes on a subset of the particles, the marked particles.
struct AmplitudeShare {
  double amplitude = 0;  ///< Σ |u_i|² over the marked particles, averaged over the modes
  /// fraction of particles that are marked; `amplitude` has this value if all particles have the same amplitude
  double particles = 0;
};
/// Computes the share of modes on marked particles, for example particles with a face-face contact. `marked` has one
/// entry per particle, which is not 0 if the particle is marked. nullopt without modes.
std::optional<AmplitudeShare> amplitude_share(const ModeSet& modes, std::span<const char> marked);

/// Density of states as a function of log10 ω, from the modes with λ above a tolerance.
struct DensityOfStates {
  Eigen::VectorXd edges;       ///< edges of the bins in log10 ω, ascending; one more than the number of bins
  Eigen::VectorXd density;     ///< fraction of all modes per unit of log10 ω
  Eigen::VectorXd cumulative;  ///< fraction of all modes below each edge, including modes without a frequency
  int without_frequency = 0;   ///< number of modes with λ at or below the tolerance
};
/// Computes the density of states in bins of equal width, from the lowest to the highest frequency. nullopt if bins < 1
/// or if all frequencies are equal. To obtain the density of states of the packing, pass all modes, see dense_modes().
std::optional<DensityOfStates> density_of_states(const Eigen::VectorXd& eigenvalues, double tolerance, int bins = 24);

}  // namespace isojam
