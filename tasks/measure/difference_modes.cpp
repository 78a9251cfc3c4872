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
constexpr Quantity exact{"unstable_exact", "/difference_modes/exact/share", group, "1", "n_-/6N"};

/// A step of the differences, in V_p^(1/3), and the quantity for the share of negative modes with this step.
struct Step {
  double h;
  Quantity share;
};
constexpr std::array steps{
    Step{1e-4, {"unstable_h4", "/difference_modes/h4/share", group, "1", "n_-/6N,\\,h=10^{-4}"}},
    Step{1e-6, {"unstable_h6", "/difference_modes/h6/share", group, "1", "n_-/6N,\\,h=10^{-6}"}},
    Step{1e-8, {"unstable_h8", "/difference_modes/h8/share", group, "1", "n_-/6N,\\,h=10^{-8}"}}};
constexpr std::array quantities{exact, steps[0].share, steps[1].share, steps[2].share};

/// Largest N. Each step needs 12N evaluations and a dense matrix with 6N rows. For this N, a state takes minutes.
constexpr int largest = 400;

void put_negative(Json& state, const Quantity& share, const std::optional<long>& negative, Eigen::Index modes,
                  std::string_view why) {
  const auto part = [&](double n) { return n / static_cast<double>(modes); };
  put(state, share, negative ? std::optional(part(static_cast<double>(*negative))) : std::nullopt, why);
  Json& json = place_of(state, share).object;
  put_optional(json, "negative", negative ? std::optional<double>(*negative) : std::nullopt, why);
}

/// An eigenvalue counts as negative if it is below minus the tolerance of the exact matrix. The differences have an
/// additional error, whose effect this measure is meant to show.
void put_step(Json& state, const Step& step, const Packing& packing, double tolerance) {
  const auto lambda = difference_modes(packing, step.h, Precision::working);
  const bool known = lambda.size() > 0 && lambda.allFinite();
  constexpr std::string_view why = "the eigenvalues did not converge";
  place_of(state, step.share).object["h"] = step.h;
  put_negative(state, step.share, known ? std::optional<long>((lambda.array() < -tolerance).count()) : std::nullopt,
               6 * Eigen::Index{packing.size()}, why);
  put_optional(place_of(state, step.share).object, "least", known ? std::optional(lambda[0]) : std::nullopt, why);
}

Json difference_record(const Packing& packing, PackingEnergy& energy) {
  Json state;
  const auto here = energy.evaluate(packing, state_precision);
  const auto matrix = dynamical_matrix(packing, energy.hessian(packing, state_precision));
  const auto ends = spectrum_ends(matrix, {.lowest = 1, .highest = 1});
  const double torque = unbalanced_torque(here, packing.solids) * greatest_inverse_mass(packing);
  const auto stability = assess(matrix, ends, torque);
  const bool known = stability.verdict != Verdict::undetermined;
  put_negative(state, exact, known ? std::optional<long>(stability.negative) : std::nullopt, matrix.rows(),
               "inertia could not be had");
  put_number(state["difference_modes"], "tolerance", stability.tolerance);
  for (const Step& step : steps) put_step(state, step, packing, stability.tolerance);
  return state;
}

Json too_large() {
  constexpr std::string_view why = "more than 400 particles";
  Json state;
  put_negative(state, exact, std::nullopt, 1, why);
  put_absent(state["difference_modes"], "tolerance", why);
  for (const Step& step : steps) {
    place_of(state, step.share).object["h"] = step.h;
    put_negative(state, step.share, std::nullopt, 1, why);
    put_absent(place_of(state, step.share).object, "least", why);
  }
  return state;
}

Measurement measure_difference_modes(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states)
    measurement.states.push_back(packing.size() > largest ? too_large() : difference_record(packing, energy));
  return measurement;
}

}  // namespace

const MeasureDefinition measures::difference_modes{.quantities = quantities, .measure = measure_difference_modes};

}  // namespace isojam
