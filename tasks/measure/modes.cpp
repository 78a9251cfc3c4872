#include <cmath>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/mode_statistics.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

constexpr std::string_view frequency = "V_p^(-1/3) sqrt(Y/ρ)";
constexpr Quantity omega_l{"omega_l", "/modes/omega_l", mode_group, frequency, "\\langle\\omega_l\\rangle"};
constexpr Quantity omega_h{"omega_h", "/modes/omega_h", mode_group, frequency, "\\langle\\omega_h\\rangle"};
constexpr Quantity zero_modes{"zero_modes", "/modes/zero", mode_group, "1", "n_0"};
constexpr Quantity negative_modes{"negative_modes", "/modes/negative", mode_group, "1", "n_-"};
constexpr Quantity p_l{"p_l", "/modes/lowest/participation", mode_group, "1", "p_l"};
constexpr Quantity p_h{"p_h", "/modes/highest/participation", mode_group, "1", "p_h"};
constexpr Quantity face_face_amplitude{"face_face_amplitude", "/modes/face_face_amplitude", mode_group, "1", "a_{ff}"};
constexpr Quantity face_face_particles{"face_face_particles", "/modes/face_face_particles", mode_group, "1", "n_{ff}"};
constexpr Quantity x_omega_l{
    "x_omega_l", "/modes/scaling/omega_l/exponent", exponent_group, "1", "x_{\\omega_l}", Quantity::Of::replicate};
constexpr Quantity x_omega_h{
    "x_omega_h", "/modes/scaling/omega_h/exponent", exponent_group, "1", "x_{\\omega_h}", Quantity::Of::replicate};
constexpr std::array quantities{omega_l,   omega_h,  zero_modes,          negative_modes,
                                p_l,       p_h,      face_face_amplitude, face_face_particles,
                                x_omega_l, x_omega_h};

/// Up to this N all modes are computed, for the density of states.
constexpr int all_modes_up_to = 150;

struct Vibrations {
  SpectrumEnds ends;
  Stability stability;
  std::optional<double> omega_l, omega_h;
};

Vibrations vibrations_of(const Packing& packing, const BlockMatrix& matrix, const Evaluation& here, int modes) {
  Vibrations vibrations;
  vibrations.ends = spectrum_ends(matrix, {.lowest = modes, .highest = modes});
  const double torque = unbalanced_torque(here, packing.solids) * greatest_inverse_mass(packing);
  vibrations.stability = assess(matrix, vibrations.ends, torque);
  vibrations.omega_l = mean_frequency(vibrations.ends.lowest, vibrations.stability.tolerance);
  vibrations.omega_h = mean_frequency(vibrations.ends.highest, vibrations.stability.tolerance);
  return vibrations;
}

/// Frequencies ω of the modes whose eigenvalue is above the tolerance.
Json frequencies(const Eigen::VectorXd& eigenvalues, double tolerance) {
  Json list = Json::array();
  for (const double value : eigenvalues) {
    if (value > tolerance) list.push_back(std::sqrt(value));
  }
  return list;
}

void put_end(Json& state, const std::string& end, const ModeSet& modes, double tolerance,
             const Quantity& participation) {
  Json& json = state["modes"][end];
  json["ended"] = to_string(modes.ended);
  json["attempts"] = modes.attempts;
  put_number(json, "residual", modes.residual);
  put_number(json, "relative_error", modes.relative_error);
  json["omega"] = frequencies(modes.eigenvalues, tolerance);
  const bool any = modes.size() > 0;
  put(state, participation, any ? std::optional(participation_ratios(modes).mean()) : std::nullopt, "no modes");
}

Json rattler_records(const Stability& stability) {
  Json list = Json::array();
  for (const auto& rattler : stability.near_rattlers) {
    Json json;
    json["particle"] = rattler.particle;
    json["reason"] = to_string(rattler.reason);
    json["contacts"] = rattler.contacts;
    put_number(json, "stiffness", rattler.least_eigenvalue);
    list.push_back(std::move(json));
  }
  return list;
}

/// Adds the share of the amplitude of the highest modes that is on particles with a face-face contact.
void put_share(Json& state, const ModeSet& highest, const ClassifiedContacts& classified, int particles) {
  std::optional<AmplitudeShare> share;
  if (!undecided(classified.analysis)) {
    std::vector<char> marked(static_cast<std::size_t>(particles), 0);
    for (const auto& pair : bonds_of(classified.contacts, classified.analysis.classes))
      marked[static_cast<std::size_t>(pair.a)] = marked[static_cast<std::size_t>(pair.b)] = 1;
    share = amplitude_share(highest, marked);
  }
  const auto why = undecided(classified.analysis).value_or("no modes");
  put(state, face_face_amplitude, share ? std::optional(share->amplitude) : std::nullopt, why);
  put(state, face_face_particles, share ? std::optional(share->particles) : std::nullopt, why);
}

Json mode_record(const Vibrations& vibrations) {
  const auto& stability = vibrations.stability;
  Json state;
  Json& json = state["modes"];
  json["verdict"] = to_string(stability.verdict);
  put(state, zero_modes, stability.zero);
  put(state, negative_modes, stability.negative);
  json["positive"] = stability.positive;
  put_number(json, "zero_tolerance", stability.tolerance);
  json["near_rattlers"] = rattler_records(stability);
  put_number(json, "lambda_max", vibrations.ends.lambda_max);
  put(state, omega_l, vibrations.omega_l, "no modes, or one without a frequency");
  put(state, omega_h, vibrations.omega_h, "no modes, or one without a frequency");
  put_end(state, "lowest", vibrations.ends.lowest, stability.tolerance, p_l);
  put_end(state, "highest", vibrations.ends.highest, stability.tolerance, p_h);
  return state;
}

void put_density(Json& modes, const BlockMatrix& matrix, double tolerance) {
  const auto density = density_of_states(dense_modes(matrix).eigenvalues, tolerance);
  if (!density) return put_absent(modes, "density_of_states", "no two frequencies differ");
  const auto list = [](const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  auto& json = modes["density_of_states"];
  json["log10_omega"] = list(density->edges);
  json["density"] = list(density->density);
  json["cumulative"] = list(density->cumulative);
}

Measurement measure_modes(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  std::vector<std::optional<double>> lowest, highest;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const Packing& packing = jam.states[k];
    const auto here = energy.evaluate(packing, state_precision);
    const auto matrix = dynamical_matrix(packing, energy.hessian(packing, state_precision));
    const auto vibrations = vibrations_of(packing, matrix, here, options.modes);
    auto state = mode_record(vibrations);
    put_share(state, vibrations.ends.highest, classified_contacts(packing, energy), packing.size());
    if (k == nearest && packing.size() <= all_modes_up_to)
      put_density(state["modes"], matrix, vibrations.stability.tolerance);
    lowest.push_back(vibrations.omega_l);
    highest.push_back(vibrations.omega_h);
    if (vibrations.stability.verdict != Verdict::stable && measurement.flags.empty())
      measurement.flags.emplace_back(to_string(Flag::not_stable));
    measurement.states.push_back(std::move(state));
  }
  put_scaling(measurement.replicate, x_omega_l, jam, lowest);
  put_scaling(measurement.replicate, x_omega_h, jam, highest);
  return measurement;
}

constexpr std::array flags{Flag::not_stable};

}  // namespace

const MeasureDefinition measures::modes{
    .quantities = quantities, .measure = measure_modes, .flags = flags, .needs_minima = true};

}  // namespace isojam
