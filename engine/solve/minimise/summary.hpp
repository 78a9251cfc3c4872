#pragma once

#include <array>
#include <string_view>

#include "engine/names/enum_names.hpp"
#include "engine/packing/energy.hpp"

namespace isojam {

/// Why a minimisation ended.
enum class StopReason {
  not_called,        ///< nothing was minimised
  residual_reached,  ///< forces balance to the residual asked for
  /// Relative energy change below the tolerance asked for, the paper's rule; not an equilibrium by itself.
  energy_change,
  unjammed,            ///< energy and forces fell to the floor of the unjammed verdict
  precision_floor,     ///< no lower residual can be resolved, not even in double-double
  budget,              ///< evaluations spent
  line_search_failed,  ///< no lower energy found along any direction tried
  cell_limit,          ///< the cell came to be so small or skew that a particle could touch two images of another
  not_finite,          ///< energy or gradient was not finite
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

/// Work of a minimisation beside its evaluations.
struct MinimiseWork {
  long double_double_evaluations = 0;  ///< of the evaluations, those in double-double
  long hessians = 0;                   ///< second derivatives of the packing, touching pairs and near ones
  long factorisations = 0;             ///< of a shifted Hessian, failed ones too
  long factor_updates = 0;             ///< systems solved by updating a factor instead of factorising anew
  long envelopes = 0;                  ///< evaluations of the multiplier method, EnvelopeEvaluation
  long envelope_overlaps = 0;          ///< overlaps with Hessian that these took
  long local_factorisations = 0;       ///< of the Hessian of a few particles

  /// Adds the work of another minimisation.
  MinimiseWork& operator+=(const MinimiseWork& term);
  bool operator==(const MinimiseWork&) const = default;
};

/// Outcome of one minimisation; the default says that none was run.
struct MinimiseSummary {
  StopReason reason = StopReason::not_called;  ///< why it ended
  double energy = 0;                           ///< E, without the work against a pressure
  double residual = 0;                         ///< as Evaluation::residual
  double residual_floor = 0;                   ///< as Evaluation::residual_floor, in the same state
  Precision precision = Precision::working;    ///< of the last evaluation
  long evaluations = 0;                        ///< of energy and forces
  long iterations = 0;                         ///< of the minimiser
  MinimiseWork work;                           ///< beside the evaluations

  bool converged() const { return reason == StopReason::residual_reached; }  ///< whether it found what was asked for
};

/// Whether forces balance to the residual asked for, or as well as double-double can tell.
inline bool is_equilibrium(const MinimiseSummary& summary) {
  return summary.converged() || summary.reason == StopReason::precision_floor;
}

}  // namespace isojam
