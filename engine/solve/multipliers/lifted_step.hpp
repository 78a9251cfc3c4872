#pragma once

#include <optional>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// A lifted step: a Newton step for the energy itself, as in sequential quadratic programming. The Taylor series of a
/// contact is taken at the ghost of B instead of at B, because the wrenches at the ghosts are already nearly correct.
/// For all contacts c with wrench ∇e_c and shift w_c, and with second derivatives H_c whose stiffness is limited to ρ =
/// `stiffness` by (H_c⁻¹ + 1/ρ)⁻¹, the step s and the new multipliers μ_c are given by
///   Σ H_c s = −Σ (∇e_c − H_c w_c),   μ_c = ∇e_c + H_c (s − w_c).
/// ρ is much larger than the stiffness of soft contacts, so it hardly changes the step. It is needed because the
/// rounding errors of very stiff contacts would otherwise exceed the stiffness of soft directions. Returns the state
/// after the step, with these multipliers. Returns nullopt if Σ H_c + `shift` is not positive definite within rounding
/// errors, or if a particle would move farther than `longest`.
std::optional<EnvelopeState> lifted_step(const EnvelopeState& state, double stiffness, double shift, double longest,
                                         EnvelopeEvaluator& evaluator, BlockCholesky& factor, MinimiseWork& work);

}  // namespace isojam
