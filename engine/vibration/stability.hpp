#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// Stability according to the counts of modes.
enum class Verdict {
  not_called,
  stable,       ///< three zero modes, no negative one: a strict minimum apart from translations
  marginal,     ///< more than three zero modes, no negative one
  unstable,     ///< at least one negative mode
  undetermined  ///< the inertia is unknown: D is not finite, or singular at every shift tried
};
template <>
inline constexpr std::array enum_names<Verdict>{
    EnumName{Verdict::not_called, "not_called"}, EnumName{Verdict::stable, "stable"},
    EnumName{Verdict::marginal, "marginal"}, EnumName{Verdict::unstable, "unstable"},
    EnumName{Verdict::undetermined, "undetermined"}};

/// A particle that its contacts may not constrain.
struct NearRattler {
  /// Reason for the classification.
  enum class Reason {
    few_contacts,        ///< fewer than four contacts
    vanishing_stiffness  ///< zero or negative: its own block of D, or a mode that is mostly its own
  };
  int particle = 0;                      ///< index of the particle
  Reason reason = Reason::few_contacts;  ///< reason for the classification
  int contacts = 0;                      ///< number of its contacts
  double least_eigenvalue = 0;           ///< smallest eigenvalue of its own block of D
};
template <>
inline constexpr std::array enum_names<NearRattler::Reason>{
    EnumName{NearRattler::Reason::few_contacts, "few_contacts"},
    EnumName{NearRattler::Reason::vanishing_stiffness, "vanishing_stiffness"}};

/// Counts of all modes.
struct Stability {
  Verdict verdict = Verdict::not_called;     ///< result
  int zero = 0, negative = 0, positive = 0;  ///< numbers among all 6N modes and strains; exact by Sylvester's inertia
  double tolerance = 0;                      ///< |λ| up to this counts as zero
  double translation_error = 0;              ///< max ‖D t‖ over the three translations; below `tolerance`
  std::vector<NearRattler> near_rattlers;    ///< sorted by particle; at most one entry per particle
};

/// Tolerance below which an eigenvalue counts as zero: rounding_bound(D, λ_max) + the largest |T_i|/R² of an unbalanced
/// torque. The second term is needed because rotations do not commute: the Hessian of a particle with a torque T
/// depends by up to T/2 on the parametrisation of small rotations.
double zero_tolerance(const BlockMatrix& matrix, double lambda_max, double unbalanced_torque = 0);

/// Largest |T_i|/R² of an evaluation, the second term of zero_tolerance.
double unbalanced_torque(const Evaluation& evaluation, const Composition& solids);

/// Counts all modes of D from the numbers of eigenvalues below −tolerance and above +tolerance, and lists
/// near-rattlers. If D with one particle pinned is above the tolerance, which a Cholesky factorisation shows, then 6N −
/// 3 modes are positive, because eigenvalues interlace. Otherwise LDLᵀ counts them. For a matrix with a border the
/// modes are those of particles and cell together. A particle needs at least four contacts: forces on fewer points
/// balance only in a plane, and nothing opposes a motion out of it to first order.
Stability assess(const BlockMatrix& matrix, const SpectrumEnds& ends, double unbalanced_torque = 0);

}  // namespace isojam
