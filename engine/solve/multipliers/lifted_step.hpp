#pragma once

#include <optional>

#include "engine/solve/factor/definite_solver.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"

namespace isojam {

/// A lifted step: a Newton step for the energy itself, as in sequential quadratic programming. For the terms, see
/// packing/envelope/proximal_contact.hpp. The Taylor series of a contact starts at the ghost of B instead of at B,
/// because the wrench at the ghost is already nearly correct. A contact c has the wrench ∇e_c, the shift w_c and the
/// second derivatives H_c. The step s and the new multipliers μ_c follow from
///   Σ H_c s = −Σ (∇e_c − H_c w_c),   μ_c = ∇e_c + H_c (s − w_c),
/// where the sums are over all contacts. The stiffness of each contact is limited to ρ = `stiffness`: H_c is replaced
/// by (H_c⁻¹ + 1/ρ)⁻¹. Without this limit, rounding errors of very stiff contacts would exceed the stiffness of soft
/// directions. ρ is much larger than the stiffness of soft contacts, so it hardly changes the step. Returns the state
/// after the step, with the new multipliers. Returns nullopt if Σ H_c + `shift`·1 is not positive definite within
/// rounding errors, or if a particle would move farther than `longest`.
std::optional<EnvelopeState> lifted_step(const EnvelopeState& state, double stiffness, double shift, double longest,
                                         EnvelopeEvaluator& evaluator, DefiniteSolver& solver, MinimiseWork& work);

}  // namespace isojam
