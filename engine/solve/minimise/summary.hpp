#pragma once

#include <array>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Reason for the end of a minimisation.
enum class StopReason {
  not_called,        ///< nothing was minimised
  residual_reached,  ///< forces balance to the requested residual
  /// Relative energy change below the requested tolerance, the paper's rule; not an equilibrium by itself.
  energy_change,
  unjammed,            ///< energy and forces are below the limits for unjammed states
  precision_floor,     ///< not even double-double resolves a smaller residual
  budget,              ///< evaluations spent
  line_search_failed,  ///< no direction led to a lower energy
  cell_limit,          ///< the cell became so small or skew that a particle could touch two images of another one
  not_finite,          ///< energy or gradient is not finite
  interrupted          ///< stop requested from outside
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

/// Work of a minimisation in addition to its evaluations.
struct MinimiseWork {
  long double_double_evaluations = 0;  ///< evaluations in double-double, included in `evaluations`
  long hessians = 0;                   ///< second derivatives of the packing, with touching and near pairs
  long factorisations = 0;             ///< factorisations of a shifted Hessian, including failed ones
  long factor_updates = 0;             ///< systems solved by updating a factor
  long envelopes = 0;                  ///< evaluations of the multiplier method, EnvelopeEvaluation
  long envelope_overlaps = 0;          ///< overlaps with Hessian in these evaluations
  long local_factorisations = 0;       ///< factorisations of the Hessian of a few particles

  /// Adds the work of another minimisation.
  MinimiseWork& operator+=(const MinimiseWork& term);
  bool operator==(const MinimiseWork&) const = default;
};

/// Result of one minimisation; by default that of none.
struct MinimiseSummary {
  StopReason reason = StopReason::not_called;  ///< reason for its end
  double energy = 0;                           ///< E, without the work against a pressure
  double residual = 0;                         ///< as Evaluation::residual
  double residual_floor = 0;                   ///< as Evaluation::residual_floor, in the same state
  Precision precision = Precision::working;    ///< precision of the last evaluation
  long evaluations = 0;                        ///< evaluations of energy and forces
  long iterations = 0;                         ///< iterations of the minimiser
  MinimiseWork work;                           ///< work in addition to the evaluations

  bool converged() const { return reason == StopReason::residual_reached; }  ///< true if the residual was reached
};

/// True if forces balance to the requested residual, or as well as double-double resolves.
inline bool is_equilibrium(const MinimiseSummary& summary) {
  return summary.converged() || summary.reason == StopReason::precision_floor;
}

}  // namespace isojam
