#include "engine/vibration/difference_modes.hpp"

#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Counts negative modes with the paper's method, in addition to the exact count. The paper's method computes the
// dynamical matrix by central differences of forces and torques in double precision, and makes it symmetric. This
// measure uses the states that the minimiser found, without relaxation along negative modes. If another measure relaxes
// them, this measure uses the relaxed states too.

constexpr QuantityGroup group{"modes by central differences",
                              "Share of negative modes, from exact derivatives and from central differences."};

struct Negative {
  Reasoned<> share, negative;
};
void describe(Fields& field, Negative& modes) {
  field("share", modes.share, "Number of negative modes, divided by 6N.")
      .range({0, 1})
      .column({"unstable_exact", group, "n_-/6N",
               "Number of negative modes of the analytic dynamical matrix, divided by 6N."});
  field("negative", modes.negative, "Number of negative modes.").range(not_negative);
}

/// Negative modes with the step h of the differences, in V_p^(1/3).
struct Step {
  double h = 0;
  Negative modes;
  Reasoned<> least;
};
void describe_step(Fields& field, Step& step, const std::string& exponent, const std::string& power) {
  field.type("difference_count", "Negative modes of a dynamical matrix from central differences.");
  field("h", step.h, "Step h of the central differences, of x and of R·θ, in units of V_p^(1/3).")
      .range(positive)
      .finite();
  field("share", step.modes.share, "Number of negative modes, divided by 6N.")
      .range({0, 1})
      .column({"unstable_h" + exponent, group, "n_-/6N,\\,h=10^{-" + exponent + "}",
               "Number of negative modes of the dynamical matrix from central differences with the step h "
               "= " +
                   power + " V_p^(1/3), divided by 6N."});
  field("negative", step.modes.negative, "Number of negative modes.").range(not_negative);
  field("least", step.least, "Smallest eigenvalue, in units of (Y/ρ)·V_p^(-2/3).");
}

struct DifferenceModes {
  Negative exact;
  Reasoned<> tolerance;
  Step h4{1e-4, {}, {}}, h6{1e-6, {}, {}}, h8{1e-8, {}, {}};
};
void describe(Fields& field, DifferenceModes& modes) {
  field("exact", modes.exact, "Negative modes of the analytic dynamical matrix.");
  field("tolerance", modes.tolerance,
        "An eigenvalue of any of the matrices counts as negative if it is below minus this value, in units of "
        "(Y/ρ)·V_p^(-2/3).");
  const auto add = [&](Step& step, const std::string& exponent, const std::string& power) {
    field.nested(
        "h" + exponent, [=, &step](Fields& inner) { describe_step(inner, step, exponent, power); },
        "Negative modes of the dynamical matrix from central differences with the step " + power + " V_p^(1/3).");
  };
  add(modes.h4, "4", "10⁻⁴");
  add(modes.h6, "6", "10⁻⁶");
  add(modes.h8, "8", "10⁻⁸");
}

struct State {
  DifferenceModes difference_modes;
};
void describe(Fields& field, State& state) {
  field("difference_modes", state.difference_modes,
        "Numbers of negative modes of the analytic dynamical matrix, and of matrices from central differences of "
        "forces and torques in double precision. All of these numbers are null if N is above 400.");
}

/// Largest N. Each step needs 12N evaluations and a dense matrix with 6N rows. For this N, a state takes minutes.
constexpr int largest = 400;

Negative negative_of(bool known, long negative, Eigen::Index modes, std::string_view why) {
  const auto count = static_cast<double>(negative);
  return {given(known, count / static_cast<double>(modes), why), given(known, count, why)};
}

/// An eigenvalue counts as negative if it is below minus the tolerance of the exact matrix. The differences have an
/// additional error, whose effect this measure is meant to show.
void measure_step(Step& step, const Packing& packing, double tolerance) {
  const auto lambda = difference_modes(packing, step.h, Precision::working);
  const bool known = lambda.size() > 0 && lambda.allFinite();
  constexpr std::string_view why = "the eigenvalues did not converge";
  const long negative = known ? (lambda.array() < -tolerance).count() : 0;
  step.modes = negative_of(known, negative, 6 * Eigen::Index{packing.size()}, why);
  step.least = given(known, known ? lambda[0] : 0, why);
}

DifferenceModes difference_record(const Packing& packing, PackingEnergy& energy) {
  const auto here = energy.evaluate(packing, state_precision);
  const auto matrix = dynamical_matrix(packing, energy.hessian(packing, state_precision));
  const auto ends = spectrum_ends(matrix, {.lowest = 1, .highest = 1});
  const double torque = unbalanced_torque(here, packing.solids) * greatest_inverse_mass(packing);
  const auto stability = assess(matrix, ends, torque);
  DifferenceModes record;
  record.exact = negative_of(stability.verdict != Verdict::undetermined, stability.negative, matrix.rows(),
                             "inertia could not be had");
  record.tolerance.value = stability.tolerance;
  for (Step* step : {&record.h4, &record.h6, &record.h8}) measure_step(*step, packing, stability.tolerance);
  return record;
}

DifferenceModes too_large() {
  const Reasoned<> none{std::nullopt, "more than 400 particles"};
  DifferenceModes record{{none, none}, none};
  for (Step* step : {&record.h4, &record.h6, &record.h8}) *step = {step->h, {none, none}, none};
  return record;
}

Measurement measure_difference_modes(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states)
    measurement.states.push_back(
        written(State{packing.size() > largest ? too_large() : difference_record(packing, energy)}));
  return measurement;
}

}  // namespace

const MeasureDefinition measures::difference_modes{.state = part_of<State>(), .measure = measure_difference_modes};

}  // namespace isojam
