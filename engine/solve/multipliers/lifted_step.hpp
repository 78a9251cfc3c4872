#pragma once

#include <optional>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Newton step for the energy itself, with the Taylor series at the ghosts instead of the contacts, because the ghosts
/// already have the correct forces (a lifted step, one of sequential quadratic programming). For all contacts c, with
/// wrench ∇e_c, shift w_c, and second derivatives H_c whose stiffness is limited to ρ = `stiffness`, (H_c⁻¹ + 1/ρ)⁻¹,
///   Σ H_c s = −Σ (∇e_c − H_c w_c),   μ_c = ∇e_c + H_c (s − w_c).
/// ρ is far above the soft contacts' stiffness and hardly changes the step; it keeps soft directions above the rounding
/// error of flat contacts. Returns the state after the step, with these multipliers. Returns nullopt if Σ H_c + `shift`
/// is not positive definite beyond rounding, or if a particle would move farther than `longest`.
std::optional<EnvelopeState> lifted_step(const EnvelopeState& state, double stiffness, double shift, double longest,
                                         EnvelopeEvaluator& evaluator, BlockCholesky& factor, MinimiseWork& work);

}  // namespace isojam
