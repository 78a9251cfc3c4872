#pragma once

#include <array>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Reason for the end of a minimisation.
enum class StopReason {
  not_called,        ///< nothing was minimised
  residual_reached,  ///< the residual is at most the requested one
  /// An iteration decreased the energy by less than the fraction MinimiseOptions::energy_change. The state is not
  /// necessarily an equilibrium.
  energy_change,
  /// The packing has no contacts, or its energy per particle is below MinimiseOptions::unjammed_energy. The method of
  /// multipliers has further criteria, see multipliers.cpp.
  unjammed,
  precision_floor,  ///< the residual is at most the residual floor in double-double
  /// The largest number of evaluations was reached. The method of multipliers also has a largest number of iterations.
  budget,
  line_search_failed,  ///< no step that lowers the energy was found
  cell_limit,          ///< the cell became so small or skew that a particle could touch two images of another particle
  not_finite,          ///< the energy or the gradient is not finite
  interrupted          ///< the caller requested a stop
};
template <>
inline constexpr std::array enum_names<StopReason>{EnumName{StopReason::not_called, "not_called"},
                                                   EnumName{StopReason::residual_reached, "residual_reached"},
                                                   EnumName{StopReason::energy_change, "energy_change"},
                                                   EnumName{StopReason::unjammed, "unjammed"},
                                                   EnumName{StopReason::precision_floor, "precision_floor"},
                                                   EnumName{StopReason::budget, "budget"},
                                                   EnumName{StopReason::line_search_failed, "line_search_failed"},
                                                   EnumName{StopReason::cell_limit, "cell_limit"},
                                                   EnumName{StopReason::not_finite, "not_finite"},
                                                   EnumName{StopReason::interrupted, "interrupted"}};

/// Numbers of operations of a minimisation, in addition to the number of evaluations.
struct MinimiseWork {
  /// evaluations in double-double; they are also counted in MinimiseSummary::evaluations
  long double_double_evaluations = 0;
  long hessians = 0;              ///< computations of the second derivatives of the whole packing
  long factorisations = 0;        ///< factorisations of a shifted Hessian, including attempts that failed
  long factor_updates = 0;        ///< linear systems that were solved by updating a factorisation
  long envelopes = 0;             ///< evaluations of the envelope (EnvelopeEvaluation) in the method of multipliers
  long envelope_overlaps = 0;     ///< overlaps with Hessian that the evaluations of the envelope computed
  long local_factorisations = 0;  ///< factorisations of the Hessian of a few particles only (local relaxation)
  long incomplete_factorisations = 0;  ///< incomplete factorisations of the Hessian, including attempts that failed
  long krylov_vectors = 0;             ///< vectors of the Krylov spaces in which steps were computed

  /// Adds the work of another minimisation.
  MinimiseWork& operator+=(const MinimiseWork& term);
  bool operator==(const MinimiseWork&) const = default;
};

/// Result of one minimisation. In a default-constructed object, nothing was minimised.
struct MinimiseSummary {
  StopReason reason = StopReason::not_called;  ///< reason for the end of the minimisation
  double energy = 0;                           ///< energy E, without the load energy of a variable cell
  double residual = 0;                         ///< Evaluation::residual in the final state
  double residual_floor = 0;                   ///< Evaluation::residual_floor in the final state
  Precision precision = Precision::working;    ///< precision of the last evaluation
  long evaluations = 0;                        ///< number of evaluations of energy and forces
  long iterations = 0;                         ///< number of iterations of the minimiser
  MinimiseWork work;                           ///< numbers of operations in addition to the evaluations

  /// true if the requested residual was reached
  bool converged() const { return reason == StopReason::residual_reached; }
};

/// True if the final residual is at most the requested residual, or at most the residual floor in double-double.
inline bool is_equilibrium(const MinimiseSummary& summary) {
  return summary.converged() || summary.reason == StopReason::precision_floor;
}

}  // namespace isojam
