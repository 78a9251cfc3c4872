#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// Stability of a state, from the numbers of its zero and negative modes.
enum class Verdict {
  not_called,
  stable,       ///< three zero modes and no negative mode: a strict minimum apart from translations
  marginal,     ///< more than three zero modes and no negative mode
  unstable,     ///< at least one negative mode
  undetermined  ///< the numbers of modes are unknown, because D is not finite or a factorisation failed
};
template <>
inline constexpr std::array enum_names<Verdict>{
    EnumName{Verdict::not_called, "not_called"}, EnumName{Verdict::stable, "stable"},
    EnumName{Verdict::marginal, "marginal"}, EnumName{Verdict::unstable, "unstable"},
    EnumName{Verdict::undetermined, "undetermined"}};

/// A near-rattler: a particle that is possibly not constrained by its contacts.
struct NearRattler {
  /// Reason for the classification.
  enum class Reason {
    few_contacts,  ///< the particle has fewer than four contacts
    /// the diagonal block of D of the particle has an eigenvalue at or below the tolerance, or the particle carries
    /// more than half of Σ|u_i|² of a mode with λ at or below the tolerance
    vanishing_stiffness
  };
  int particle = 0;                      ///< index of the particle
  Reason reason = Reason::few_contacts;  ///< reason for the classification
  int contacts = 0;                      ///< number of contacts of the particle
  double least_eigenvalue = 0;           ///< smallest eigenvalue of the diagonal block of D of the particle
};
template <>
inline constexpr std::array enum_names<NearRattler::Reason>{
    EnumName{NearRattler::Reason::few_contacts, "few_contacts"},
    EnumName{NearRattler::Reason::vanishing_stiffness, "vanishing_stiffness"}};

/// Numbers of zero, negative and positive modes, and the near-rattlers of a state.
struct Stability {
  Verdict verdict = Verdict::not_called;  ///< stability that follows from the numbers of modes
  /// Numbers of modes, exact by Sylvester's law of inertia. If the matrix has a border, they include the modes of the
  /// cell.
  int zero = 0, negative = 0, positive = 0;
  double tolerance = 0;  ///< an eigenvalue counts as zero if |λ| is at most this large
  /// largest ‖D t‖ of the three translations t, a check: it should be below `tolerance`
  double translation_error = 0;
  std::vector<NearRattler> near_rattlers;  ///< near-rattlers, sorted by particle; at most one entry per particle
};

/// Tolerance below which an eigenvalue counts as zero: rounding_bound(D, λ_max) + `unbalanced_torque`. The second term
/// is needed because rotations do not commute: if a net torque T acts on a particle, the Hessian depends by up to T/2
/// on the parametrisation of small rotations.
double zero_tolerance(const BlockMatrix& matrix, double lambda_max, double unbalanced_torque = 0);

/// The largest |T_i|/R² of all particles i, where T_i is the net torque. It is the second term of zero_tolerance() for
/// the Hessian. For D, it must be multiplied by greatest_inverse_mass().
double unbalanced_torque(const Evaluation& evaluation, const Composition& solids);

/// Counts the modes of D: eigenvalues below −tolerance are negative, eigenvalues above +tolerance are positive, and all
/// others are zero modes. If the matrix has a border, the modes are those of particles and cell together. Also finds
/// the near-rattlers. A particle with fewer than four contacts is a near-rattler: the forces of three contacts can
/// balance only in a plane, and nothing opposes a motion out of this plane to first order. Method: let D' be D with one
/// pinned particle (pinned_matrix()). If D' − tolerance·1 has a Cholesky factorisation, all eigenvalues of D' are above
/// the tolerance. Because eigenvalues interlace, 6N − 3 modes of D are then positive. Otherwise an LDLᵀ factorisation
/// counts the modes.
Stability assess(const BlockMatrix& matrix, const SpectrumEnds& ends, double unbalanced_torque = 0);

}  // namespace isojam
