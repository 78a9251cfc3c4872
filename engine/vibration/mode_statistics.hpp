#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// Participation ratio p = (Σ_i |u_i|²)² / (N Σ_i |u_i|⁴) of a mode, where u_i contains the six entries of particle i.
/// It is 1 if all particles have the same amplitude |u_i|, and 1/N if only one particle moves. At least one of the 6N
/// entries must not be 0.
double participation_ratio(const Eigen::Ref<const Eigen::VectorXd>& mode);
/// Participation ratios of all modes, in the order of the modes.
Eigen::VectorXd participation_ratios(const ModeSet& modes);

/// Mean frequency ⟨ω⟩ of a set of modes, with ω = √λ in units of V_p^(-1/3)·√(Y/ρ). It is ⟨ω_l⟩ in the paper's Fig.
/// 1(b) for the lowest modes, and ⟨ω_h⟩ for the highest modes. nullopt if the set is empty, or if at least one mode has
/// no frequency because its λ is not above `tolerance`.
std::optional<double> mean_frequency(const ModeSet& modes, double tolerance);

/// The part of the amplitude of modes that belongs to marked particles.
struct AmplitudeShare {
  double amplitude = 0;  ///< Σ |u_i|² over the marked particles, averaged over the modes
  /// fraction of particles that are marked; `amplitude` has this value if all particles have the same amplitude
  double particles = 0;
};
/// Computes the part of the amplitude that belongs to marked particles, for example to particles with a face-face
/// contact. `marked` has one entry per particle, which is not 0 if the particle is marked. nullopt if there is no mode
/// or no particle.
std::optional<AmplitudeShare> amplitude_share(const ModeSet& modes, std::span<const char> marked);

/// Density of states as a function of log10 ω.
struct DensityOfStates {
  Eigen::VectorXd edges;       ///< edges of the bins in log10 ω, ascending; one more than the number of bins
  Eigen::VectorXd density;     ///< fraction of all modes per unit of log10 ω, in each bin
  Eigen::VectorXd cumulative;  ///< fraction of all modes below each edge, including modes without a frequency
  int without_frequency = 0;   ///< number of modes with λ at or below the tolerance, which have no frequency
};
/// Computes the density of states in bins of equal width, from the lowest to the highest frequency. Modes with λ at or
/// below `tolerance` have no frequency. nullopt if bins < 1, or if there are not two different frequencies. To obtain
/// the density of states of a packing, pass the eigenvalues of all its modes (dense_modes()).
std::optional<DensityOfStates> density_of_states(const Eigen::VectorXd& eigenvalues, double tolerance, int bins = 24);

}  // namespace isojam
