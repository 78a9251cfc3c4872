#pragma once

#include <optional>

#include "engine/solve/factor/block_cholesky.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// Newton's step for the energy itself, its series taken not where the contacts are but where their ghosts are, which
/// bear the right forces already (a lifted step, one of sequential quadratic programming). For all contacts c, with
/// wrench ∇e_c, shift w_c, and second derivatives H_c of which none is stiffer than ρ = `stiffness`,
/// (H_c⁻¹ + 1/ρ)⁻¹,
///   Σ H_c s = −Σ (∇e_c − H_c w_c),   μ_c = ∇e_c + H_c (s − w_c).
/// Far above the soft contacts' stiffness, ρ changes next to nothing of the step, and keeps soft directions above what
/// rounding makes of flat contacts. The state there, with those multipliers; nullopt if Σ H_c + `shift`, or what
/// rounding takes for it, is not positive definite or a particle would move farther than `longest`.
std::optional<EnvelopeState> lifted_step(const EnvelopeState& state, double stiffness, double shift, double longest,
                                         EnvelopeEvaluator& evaluator, BlockCholesky& factor, MinimiseWork& work);

}  // namespace isojam
