#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// Participation ratio p = (Σ_i |u_i|²)² / (N Σ_i |u_i|⁴), u_i the six entries of particle i: 1 if all move alike, 1/N
/// if one does. A mode has 6N entries, not all 0.
double participation_ratio(const Eigen::Ref<const Eigen::VectorXd>& mode);
/// Participation ratios of all modes, in their order.
Eigen::VectorXd participation_ratios(const ModeSet& modes);

/// Mean frequency ⟨ω⟩ over a set, ω = √λ in V_p^(-1/3)·√(Y/ρ), as in the paper's Fig. 1(b): ⟨ω_l⟩ of the lowest
/// modes, ⟨ω_h⟩ of the highest. nullopt if the set is empty or a λ is not above `tolerance`: such a mode has no
/// frequency.
std::optional<double> mean_frequency(const ModeSet& modes, double tolerance);

/// Share of the amplitude of modes that some particles have.
struct AmplitudeShare {
  double amplitude = 0;  ///< Σ |u_i|² over the particles marked, mean over the modes
  double particles = 0;  ///< share of particles marked: the amplitude of modes that do not care
};
/// Share of the particles `marked`, one entry each, nonzero to count it; such as those with a face-face contact.
/// nullopt without modes.
std::optional<AmplitudeShare> amplitude_share(const ModeSet& modes, std::span<const char> marked);

/// Density of states over log10 ω, of the modes with λ above a tolerance.
struct DensityOfStates {
  Eigen::VectorXd edges;       ///< of the bins, log10 ω, ascending; bins + 1
  Eigen::VectorXd density;     ///< share of all modes per unit of log10 ω
  Eigen::VectorXd cumulative;  ///< share of all modes below each edge, modes without a frequency included
  int without_frequency = 0;   ///< modes with λ up to the tolerance
};
/// Density of states in `bins` of equal width from the lowest to the highest. nullopt if bins < 1 or no two frequencies
/// differ. From all modes (dense_modes) it is that of the packing.
std::optional<DensityOfStates> density_of_states(const Eigen::VectorXd& eigenvalues, double tolerance, int bins = 24);

}  // namespace isojam
