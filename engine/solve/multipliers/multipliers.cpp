#include "engine/solve/multipliers/multipliers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "engine/arithmetic/elementary.hpp"
#include "engine/solve/factor/definite_solver.hpp"
#include "engine/solve/minimise/descent.hpp"
#include "engine/solve/multipliers/envelope_descent.hpp"
#include "engine/solve/multipliers/envelope_state.hpp"
#include "engine/solve/multipliers/lifted_step.hpp"
#include "engine/solve/multipliers/tangent.hpp"

// Near jamming all contact forces have similar magnitude, f ~ Δφ⁵. The depth of a contact therefore depends on its
// kind: it is ~ Δφ for corners and crossed edges, and ~ Δφ⁵ for flat contacts of two faces. A flat contact is a spring
// of stiffness 0.1 Y·V_p^(1/3) with a range of 1e-10. Corners and crossed edges are springs of stiffness ~ Δφ⁴ with a
// range of Δφ. Newton's method for the energy itself must find the flat contacts again in every step. In the method of
// multipliers, the energy of each contact is replaced by its Moreau envelope with the multiplier μ
// (proximal_contact.hpp). μ is an estimate of the force of the contact. The envelope limits the stiffness of the
// contact to
//
//   ρ = stiffening · k₀,   k₀ = f/Δφ,
//
// where k₀ is the stiffness of soft contacts and f is the mean contact force. Φ is the sum of all envelopes. The method
// consists of
//
//   start        The start is the equilibrium at φ₀ with μ₀ = ∇e. Let r = Δφ₁/Δφ₀ for the new density φ₁. The packing
//                is strained and follows the tangent, which needs one linear solution. The multipliers are scaled by
//                r⁵.
//   multipliers  Outer iteration: Φ is minimised until its gradient is below the error of μ, |∇Φ| < ½ max |∇e − μ|.
//                Then μ is renewed, μ ← ∇e. At the end all shifts are 0, and Φ is the energy (Hestenes 1969, Powell
//                1969).
//   descent      Inner iteration: Levenberg–Marquardt steps for Φ in Krylov spaces (envelope_descent.hpp).
//   finish       When forces and multipliers agree to about 3 %, lifted steps (lifted_step.hpp) follow, which converge
//                quadratically. They end when the residual of the energy itself is small enough in double-double.
//
// A solution branch is smooth until it ends at a fold. There a packing rearranges and its energy decreases,
// occasionally by orders of magnitude. The scales f and Δφ are then set again from the present forces.
//
// docs/accuracy.md has the figures.

namespace isojam {

namespace {

/// ρ/k₀. ρ is far above the stiffness k₀ of corners and crossed edges, and far below the stiffness 0.1 Y·V_p^(1/3) of
/// faces.
constexpr double stiffening = 300;
/// A contact whose stiffness is below this fraction of ρ is not replaced by its envelope, which would hardly differ.
constexpr double plain_below = 0.1;

constexpr double tangent_shift = 0.01;  ///< λ/k₀ for the tangent at the initial equilibrium

/// Residual of a contact below which descent computes its shift by a series. It needs nearly half as many overlaps
/// then.
constexpr double series_below = 1e-3;

/// μ is renewed when |∇Φ| is below this fraction of the error of μ.
constexpr double balance_before_renewal = 0.5;

/// finish_from: lifted steps begin when |∇Φ| and the error of μ are below this fraction of the mean force. Each failed
/// attempt divides the fraction by ten. finish_to: below this fraction, Newton's method for the energy replaces the
/// method of multipliers, with at most `last_evaluations` evaluations.
constexpr double finish_from = 0.03, finish_to = 1e-7;
constexpr double lifted_stiffening = 1e8, lifted_shift = 1e-7;  ///< ρ/k₀ and λ/k₀ in lifted steps
constexpr long last_evaluations = 500;

/// The residual of the energy itself is computed only if the residual of the envelope is below this.
constexpr double nearly_balanced = 1e-3;

constexpr double longest_step = 0.1, longest_tangent = 0.4;  ///< in units of the inradius

/// Limits for the number of successive renewals of the multipliers that neither halve the error nor lower Φ by the
/// fraction `least_fall`. After `damped_after` renewals, they are damped, since they can alternate between the two
/// sides of a kink. After `most_renewals`, Newton's method replaces the method of multipliers.
constexpr int damped_after = 3, most_renewals = 15;
constexpr double damped_part = 0.5;
constexpr double least_fall = 1e-4;

/// off_scale: scales are set again if the mean force differs from their force by more than this factor. unjammed_force:
/// the packing is unjammed if the mean force is below this fraction of the expected force.
constexpr double off_scale = 3, unjammed_force = 1e-9;
/// A packing is unjammed if its energy per particle is below this fraction of force · (φ − φ_J). A limit in Y·V_p would
/// not work: close to jamming the energy of a jammed packing is below any fixed limit.
constexpr double unjammed_energy = 1e-6;

/// If so many consecutive states have too few contacts for rigidity, the packing is assumed to be unjammed, and
/// Newton's method decides.
constexpr int most_nonrigid_states = 10;

/// Limits far above the need of all states except those at the end of their solution branch, which slide a long way.
/// A step shorter than `short_step` · (φ − φ_J) may need `patience` times as much: it meets the end of the branch
/// because the branch ends there, and not because the step is too long, so that a shorter one would meet it as well.
constexpr double most_steps = 600, most_envelopes = 3000, short_step = 0.05, patience = 10;

/// A larger packing has more rearrangements in a strain step, and each of them limits the steps of the whole packing.
/// The limits of the numbers of steps and renewals are therefore proportional to N above this N.
constexpr double limits_hold_for = 400;

/// True if the packing cannot be rigid (Maxwell): even with three constraints for every contact, as for two faces,
/// there are fewer constraints than degrees of freedom of the particles that have contacts.
bool cannot_be_rigid(const EnvelopeEvaluation& value) {
  std::vector<char> touched(static_cast<std::size_t>(value.gradient.size() / 6), 0);
  for (const EnvelopeContact& contact : value.contacts) {
    if (contact.at->touching) touched[contact.pair.a] = touched[contact.pair.b] = 1;
  }
  return 3 * value.touching < 6 * std::count(touched.begin(), touched.end(), 1) - 3;
}

class Multipliers {
 public:
  Multipliers(Packing& packing, double distance, PackingEnergy& energy, const MinimiseOptions& options,
              std::stop_token stop)
      : packing_(packing),
        distance_(distance),
        energy_(energy),
        options_(options),
        stop_(std::move(stop)),
        evaluator_(Enthalpy(options.control, packing.cell), summary_.work),
        descent_(evaluator_, complete_, summary_.work),
        here_{packing, {}} {}

  /// Follows the equilibrium to another density.
  MinimiseSummary follow(double density) {
    if (packing_.density() - density < short_step * distance_) patience_ = patience;
    const Packing strained = strained_to(packing_, density);
    const double stretch = strained.cell.side() / packing_.cell.side() - 1;
    follow_tangent(strained, stretch * Eigen::Matrix3d::Identity(), distance_ - (packing_.density() - density));
    return run();
  }

  /// Follows the equilibrium in the cell deformed by F.
  MinimiseSummary follow(const DoubleDoubleMatrix& f) {
    follow_tangent(deformed(packing_, f), f.high - Eigen::Matrix3d::Identity(), distance_);
    return run();
  }

  /// Follows the equilibrium to the load of the options. The expected Δφ follows from p ∝ Δφ⁵.
  MinimiseSummary follow_load() {
    const double now = energy_.evaluate(packing_, Precision::double_double).pressure;
    follow_tangent(packing_, Eigen::Matrix3d::Zero(), distance_ * nearest::pow(options_.control.pressure / now, 0.2));
    return run();
  }

  /// Relaxes the present state to an equilibrium.
  MinimiseSummary relax(double force) {
    first_force_ = force;
    set_scales(force, distance_);
    here_ = evaluator_.at(packing_, {});
    return run();
  }

 private:
  MinimiseSummary run() {
    summary_.reason = descend();
    if (is_equilibrium(summary_)) return summary_;
    packing_ = std::move(here_.packing);
    if (summary_.reason == StopReason::line_search_failed || summary_.reason == StopReason::unjammed) {
      polish();
    } else {
      measure();
    }
    return summary_;
  }

  /// Sets the scales from a mean force and Δφ.
  void set_scales(double force, double distance) {
    force_ = force;
    descent_.set_stiffness(force / distance);
    evaluator_.set_stiffness(stiffening * descent_.stiffness());
  }

  /// Predicts the state for Δφ = `distance` from the equilibrium `packing_`. `strained` is packing_ after the strain
  /// `imposed`.
  void follow_tangent(const Packing& strained, const Eigen::Matrix3d& imposed, double distance) {
    const double ratio = distance / distance_;
    assert(ratio > 0);
    // The scales need the mean force, which does not depend on them.
    evaluator_.set_stiffness(1);
    first_force_ = evaluator_.unshifted(packing_).value.mean_force;
    set_scales(first_force_, distance_);
    const EnvelopeState from = evaluator_.unshifted(packing_);
    const double fall = nearest::pow(ratio, 5);
    Tangent answer = tangent(from, imposed, tangent_shift * descent_.stiffness(),
                             longest_tangent * packing_.solids.least_inradius(), evaluator_, solver_, summary_.work);
    for (ContactMultiplier& force : answer.forces) force.multiplier *= fall;
    mark_soft(from.value, plain_below * stiffening * descent_.stiffness(), answer.forces);
    set_scales(fall * first_force_, distance);
    here_ = evaluator_.at(moved(strained, answer.step), answer.forces);
  }

  /// Factor of the limits: N in units of limits_hold_for, at least 1.
  double size() const { return std::max(1.0, here_.packing.size() / limits_hold_for); }

  std::optional<StopReason> verdict() const {
    const EnvelopeEvaluation& value = here_.value;
    if (evaluator_.cell_limit()) return StopReason::cell_limit;
    if (!std::isfinite(value.value) || !value.gradient.allFinite()) return StopReason::not_finite;
    if (value.touching == 0 || value.mean_force < unjammed_force * expected_force_ ||
        nonrigid_states_ > most_nonrigid_states) {
      // Under a pressure a packing is always jammed; Newton's method then decides.
      return frees_volume(options_.control.cell) ? StopReason::line_search_failed : StopReason::unjammed;
    }
    if (stop_.stop_requested()) return StopReason::interrupted;
    if (descent_.failed()) return StopReason::line_search_failed;
    const double most = std::min(patience_ * most_envelopes * size(),
                                 static_cast<double>(options_.max_evaluations - summary_.evaluations));
    if (static_cast<double>(summary_.work.envelopes) >= most ||
        static_cast<double>(summary_.work.hessians) >= patience_ * most_steps * size())
      return StopReason::budget;
    return std::nullopt;
  }

  StopReason descend() {
    expected_force_ = force_;
    evaluator_.set_series_below(series_below);
    double finish_at = finish_from;
    while (true) {
      if (const auto reason = verdict()) return *reason;
      const double force = here_.value.mean_force, imbalance = largest_displacement(here_.value.gradient);
      const double error = here_.value.multiplier_error;
      if (stalled(std::max(imbalance, error) / force)) return StopReason::line_search_failed;
      if (std::max(imbalance, error) < finish_at * force) {
        if (const auto reason = finish()) return *reason;
        finish_at /= 10;
        if (finish_at < finish_to) return StopReason::line_search_failed;
      } else if (imbalance < balance_before_renewal * error) {
        renew_multipliers();
      } else {
        advance();
      }
    }
  }

  /// True if the last renewals of the multipliers made no progress. Near a saddle they would otherwise never end.
  bool stalled(double wrong) {
    const double value = here_.value.value;
    const bool lower = !std::isfinite(lowest_) || lowest_ - value > least_fall / size() * std::abs(lowest_);
    if (wrong < best_ / 2 || lower) best_ = wrong, lowest_ = value, renewals_ = 0;
    return renewals_ > most_renewals * size();
  }

  void renew_multipliers() {
    ++renewals_;
    const double force = here_.value.mean_force;
    if (!(force > force_ / off_scale && force < off_scale * force_))
      set_scales(force, distance_ * nearest::pow(force / first_force_, 0.2));
    std::vector<ContactMultiplier> forces = forces_of(here_.value);
    const double part = renewals_ > damped_after ? damped_part : 1;
    for (std::size_t k = 0; k < forces.size(); ++k)
      forces[k].multiplier += part * (here_.value.contacts[k].at->wrench - forces[k].multiplier);
    mark_soft(here_.value, plain_below * stiffening * descent_.stiffness(), forces);
    here_ = evaluator_.at(std::move(here_.packing), forces);
  }

  void advance() {
    auto there =
        descent_.step(here_, longest_step * packing_.solids.least_inradius(), [&] { return verdict().has_value(); });
    if (!there) return;
    here_ = std::move(*there);
    nonrigid_states_ = cannot_be_rigid(here_.value) ? nonrigid_states_ + 1 : 0;
    ++summary_.iterations;
  }

  /// Makes lifted steps while each of them halves the error, and later the residual. Returns the reason to stop if the
  /// result is an equilibrium.
  std::optional<StopReason> finish() {
    const auto wrong = [](const EnvelopeEvaluation& value) {
      return std::max(largest_displacement(value.gradient), value.multiplier_error);
    };
    double residual = std::numeric_limits<double>::infinity();
    evaluator_.set_series_below(0);
    while (!verdict()) {
      ++summary_.work.hessians;
      auto there = lifted_step(here_, lifted_stiffening * descent_.stiffness(), lifted_shift * descent_.stiffness(),
                               longest_step * packing_.solids.least_inradius(), evaluator_, solver_, summary_.work);
      if (!there) break;
      const bool better = wrong(there->value) < wrong(here_.value) / 2;
      const bool balanced = wrong(there->value) < nearly_balanced * there->value.mean_force;
      if (!better && !balanced) break;
      if (balanced) {
        packing_ = there->packing;
        measure();
        if (summary_.residual <= options_.residual) return StopReason::residual_reached;
        if (summary_.residual <= summary_.residual_floor) return StopReason::precision_floor;
        if (!better && !(summary_.residual < residual / 2)) break;
        residual = summary_.residual;
      }
      here_ = std::move(*there);
      ++summary_.iterations;
    }
    evaluator_.set_series_below(series_below);
    return std::nullopt;
  }

  /// Evaluates the energy itself in the present state.
  void measure() {
    const Evaluation value = evaluator_.load().of(energy_.evaluate(packing_, Precision::double_double), packing_);
    ++summary_.evaluations;
    ++summary_.work.double_double_evaluations;
    summary_.energy = value.energy - value.load_energy;
    summary_.residual = value.residual;
    summary_.residual_floor = value.residual_floor;
    summary_.precision = Precision::double_double;
  }

  /// Newton's method for the energy, which reduces the residual that the method of multipliers leaves.
  void polish() {
    complete_ = {};  // to release its memory: Newton's method has a factorisation of its own
    MinimiseOptions options = options_;
    options.method = Method::newton;
    options.max_evaluations = std::min(last_evaluations, options_.max_evaluations);
    options.unjammed_energy = std::min(options_.unjammed_energy, unjammed_energy * expected_force_ * distance_);
    const MinimiseSummary rest = minimise(packing_, energy_, options, stop_);
    MinimiseSummary sum = rest;
    // If Newton's method finds no equilibrium either, the earlier reason is kept.
    if (summary_.reason == StopReason::unjammed && rest.reason == StopReason::budget) sum.reason = summary_.reason;
    sum.evaluations += summary_.evaluations;
    sum.iterations += summary_.iterations;
    sum.work += summary_.work;
    summary_ = sum;
  }

  BlockCholesky complete_;  ///< used by solver_ and descent_ in turn
  DefiniteSolver solver_{complete_};
  Packing& packing_;
  double distance_;
  double patience_ = 1;  ///< factor of the limits
  PackingEnergy& energy_;
  const MinimiseOptions& options_;
  std::stop_token stop_;
  MinimiseSummary summary_;
  EnvelopeEvaluator evaluator_;
  EnvelopeDescent descent_;
  EnvelopeState here_;
  double first_force_ = 0;                                 ///< mean force of the initial equilibrium
  double expected_force_ = 0;                              ///< mean force that is expected if there is no rearrangement
  double force_ = 0;                                       ///< mean force that sets the scales
  double best_ = std::numeric_limits<double>::infinity();  ///< error/mean force at the last renewal with progress
  double lowest_ = std::numeric_limits<double>::infinity();  ///< Φ at the last renewal with progress
  int renewals_ = 0;                                         ///< number of renewals since then
  int nonrigid_states_ = 0;                                  ///< consecutive states that cannot be rigid
};

}  // namespace

MinimiseSummary follow_equilibrium(Packing& packing, double density, double distance, PackingEnergy& energy,
                                   const MinimiseOptions& options, std::stop_token stop) {
  return Multipliers(packing, distance, energy, options, std::move(stop)).follow(density);
}

MinimiseSummary follow_deformation(Packing& packing, const DoubleDoubleMatrix& f, double distance,
                                   PackingEnergy& energy, const MinimiseOptions& options, std::stop_token stop) {
  return Multipliers(packing, distance, energy, options, std::move(stop)).follow(f);
}

MinimiseSummary follow_load(Packing& packing, double distance, PackingEnergy& energy, const MinimiseOptions& options,
                            std::stop_token stop) {
  return Multipliers(packing, distance, energy, options, std::move(stop)).follow_load();
}

MinimiseSummary relax_to_equilibrium(Packing& packing, double force, double distance, PackingEnergy& energy,
                                     const MinimiseOptions& options, std::stop_token stop) {
  return Multipliers(packing, distance, energy, options, std::move(stop)).relax(force);
}

}  // namespace isojam
