#include <cmath>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/mode_statistics.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/measure/parts.hpp"

namespace isojam {
namespace {

/// Packings up to this size have all their modes computed for the density of states.
constexpr int all_modes_up_to = 150;

struct Vibrations {
  SpectrumEnds ends;
  Stability stability;
  std::optional<double> omega_l, omega_h;
};

Vibrations vibrations_of(const Packing& packing, const BlockMatrix& hessian, const Evaluation& here, int modes) {
  Vibrations vibrations;
  vibrations.ends = spectrum_ends(hessian, {.lowest = modes, .highest = modes});
  vibrations.stability = assess(hessian, vibrations.ends, unbalanced_torque(here, packing.solid->gyration_radius()));
  vibrations.omega_l = mean_frequency(vibrations.ends.lowest, vibrations.stability.tolerance);
  vibrations.omega_h = mean_frequency(vibrations.ends.highest, vibrations.stability.tolerance);
  return vibrations;
}

/// ω of modes above the tolerance.
Json frequencies(const Eigen::VectorXd& eigenvalues, double tolerance) {
  Json list = Json::array();
  for (const double value : eigenvalues) {
    if (value > tolerance) list.push_back(std::sqrt(value));
  }
  return list;
}

Json end_record(const ModeSet& modes, double tolerance) {
  Json json;
  json["ended"] = to_string(modes.ended);
  json["attempts"] = modes.attempts;
  put_number(json, "residual", modes.residual);
  put_number(json, "relative_error", modes.relative_error);
  json["omega"] = frequencies(modes.eigenvalues, tolerance);
  const bool any = modes.size() > 0;
  put_optional(json, "participation", any ? std::optional(participation_ratios(modes).mean()) : std::nullopt,
               "no modes");
  return json;
}

Json rattler_records(const Stability& stability) {
  Json list = Json::array();
  for (const auto& rattler : stability.near_rattlers) {
    Json json;
    json["particle"] = rattler.particle;
    json["reason"] = to_string(rattler.reason);
    json["contacts"] = rattler.contacts;
    put_number(json, "stiffness", rattler.stiffness);
    list.push_back(std::move(json));
  }
  return list;
}

/// Whether the highest modes sit on particles with a face-face contact.
void put_share(Json& json, const ModeSet& highest, const ClassifiedContacts& classified, int particles) {
  std::optional<AmplitudeShare> share;
  if (!undecided(classified.analysis)) {
    std::vector<char> marked(static_cast<std::size_t>(particles), 0);
    for (const auto& pair : bonds_of(classified.contacts, classified.analysis.classes))
      marked[static_cast<std::size_t>(pair.a)] = marked[static_cast<std::size_t>(pair.b)] = 1;
    share = amplitude_share(highest, marked);
  }
  const auto why = undecided(classified.analysis).value_or("no modes");
  put_optional(json, "face_face_amplitude", share ? std::optional(share->amplitude) : std::nullopt, why);
  put_optional(json, "face_face_particles", share ? std::optional(share->particles) : std::nullopt, why);
}

Json mode_record(const Vibrations& vibrations) {
  const auto& stability = vibrations.stability;
  Json json;
  json["verdict"] = to_string(stability.verdict);
  json["zero"] = stability.zero;
  json["negative"] = stability.negative;
  json["positive"] = stability.positive;
  put_number(json, "zero_tolerance", stability.tolerance);
  json["near_rattlers"] = rattler_records(stability);
  put_number(json, "lambda_max", vibrations.ends.stiffness);
  put_optional(json, "omega_l", vibrations.omega_l, "no modes, or one without a frequency");
  put_optional(json, "omega_h", vibrations.omega_h, "no modes, or one without a frequency");
  json["lowest"] = end_record(vibrations.ends.lowest, stability.tolerance);
  json["highest"] = end_record(vibrations.ends.highest, stability.tolerance);
  return json;
}

void put_density(Json& modes, const BlockMatrix& hessian, double tolerance) {
  const auto density = density_of_states(dense_modes(hessian).eigenvalues, tolerance);
  if (!density) return put_absent(modes, "density_of_states", "no two frequencies differ");
  const auto list = [](const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  auto& json = modes["density_of_states"];
  json["log10_omega"] = list(density->edges);
  json["density"] = list(density->density);
  json["cumulative"] = list(density->cumulative);
}

}  // namespace

Measurement measure_modes(const JamResult& jam, int modes) {
  Measurement measurement;
  PackingEnergy energy;
  std::vector<std::optional<double>> omega_l, omega_h;
  const auto nearest = nearest_state(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const Packing& packing = jam.states[k];
    const Precision precision = jam.path[jam.state_steps[k]].summary.precision;
    const auto here = energy.evaluate(packing, precision);
    const auto hessian = energy.hessian(packing, precision);
    const auto vibrations = vibrations_of(packing, hessian, here, modes);
    auto json = mode_record(vibrations);
    put_share(json, vibrations.ends.highest, classified_contacts(packing, energy), packing.size());
    if (k == nearest && packing.size() <= all_modes_up_to) put_density(json, hessian, vibrations.stability.tolerance);
    omega_l.push_back(vibrations.omega_l);
    omega_h.push_back(vibrations.omega_h);
    if (vibrations.stability.verdict != Verdict::stable && measurement.flags.empty())
      measurement.flags.emplace_back("not_stable");
    measurement.states.push_back({{"modes", std::move(json)}});
  }
  measurement.replicate["mode_scaling"] = {{"omega_l", scaling_record(jam, omega_l)},
                                           {"omega_h", scaling_record(jam, omega_h)}};
  return measurement;
}

}  // namespace isojam
