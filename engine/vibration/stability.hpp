#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/spectrum.hpp"

namespace isojam {

/// What the counts of modes say.
enum class Verdict {
  not_called,
  stable,       ///< three zero modes, no negative one: a strict minimum but for translations
  marginal,     ///< further zero modes, none negative
  unstable,     ///< negative modes
  undetermined  ///< inertia could not be had: D is not finite, or singular wherever it was tried
};
template <>
inline constexpr std::array enum_names<Verdict>{
    EnumName{Verdict::not_called, "not_called"}, EnumName{Verdict::stable, "stable"},
    EnumName{Verdict::marginal, "marginal"}, EnumName{Verdict::unstable, "unstable"},
    EnumName{Verdict::undetermined, "undetermined"}};

/// A particle that its contacts may not hold.
struct NearRattler {
  /// Why.
  enum class Reason {
    few_contacts,        ///< fewer than four
    vanishing_stiffness  ///< a zero or negative mode with all others at rest, or one that is mostly its own
  };
  int particle = 0;                      ///< by number
  Reason reason = Reason::few_contacts;  ///< why it may be loose
  int contacts = 0;                      ///< of the particle
  double least_eigenvalue = 0;           ///< of its own block of D
};
template <>
inline constexpr std::array enum_names<NearRattler::Reason>{
    EnumName{NearRattler::Reason::few_contacts, "few_contacts"},
    EnumName{NearRattler::Reason::vanishing_stiffness, "vanishing_stiffness"}};

/// Counts of all modes.
struct Stability {
  Verdict verdict = Verdict::not_called;     ///< what they say
  int zero = 0, negative = 0, positive = 0;  ///< of all 6N modes, and strains, exact by Sylvester's inertia
  double tolerance = 0;                      ///< |λ| up to this is zero
  double translation_error = 0;              ///< max ‖D t‖ over the three translations; below tolerance
  std::vector<NearRattler> near_rattlers;    ///< ascending by particle; at most one entry for each
};

/// Tolerance that separates zero from small: rounding_bound(D, λ_max) + the largest |T_i|/R² of an unbalanced torque.
/// The second, because turns do not commute: the Hessian of a particle that feels a torque T depends by up to T/2 on
/// what is meant by a small turn.
double zero_tolerance(const BlockMatrix& matrix, double lambda_max, double unbalanced_torque = 0);

/// Largest |T_i|/R² of an evaluation, the second argument of zero_tolerance.
double unbalanced_torque(const Evaluation& evaluation, const Composition& solids);

/// Counts all modes of D, by the number of eigenvalues below −tolerance and above +tolerance, and names near-rattlers.
/// A packing whose D with one particle pinned is above the tolerance has 6N − 3 positive modes (eigenvalues
/// interlace), which a Cholesky factorisation shows; anything else is counted by LDLᵀ.
/// Of a matrix with a border those directions are counted in which particles and cell move together.
/// Four contacts are the fewest that can hold a particle: forces on fewer than four points balance in a plane, and
/// nothing opposes a motion out of it to first order.
Stability assess(const BlockMatrix& matrix, const SpectrumEnds& ends, double unbalanced_torque = 0);

}  // namespace isojam
