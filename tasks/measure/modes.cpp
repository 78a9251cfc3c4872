#include <cmath>

#include "engine/analysis/clusters.hpp"
#include "engine/packing/energy.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/mode_statistics.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/measure/flag.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {

void describe(Fields& field, NearRattler& rattler) {
  field("particle", rattler.particle, "Index of the particle.");
  field("reason", rattler.reason,
        "Reason why the particle is a near-rattler. `few_contacts`: The particle has fewer than four contacts. "
        "`vanishing_stiffness`: The value of `stiffness` counts as zero or is negative, or more than half of the "
        "squared amplitude of a zero or negative mode belongs to this particle.");
  field("contacts", rattler.contacts, "Number of contacts of the particle.");
  field("stiffness", rattler.least_eigenvalue,
        "Smallest eigenvalue of the diagonal 6×6 block of D that belongs to the particle, in units of "
        "(Y/ρ)·V_p^(-2/3).");
}

namespace {

constexpr const char* frequency = "V_p^(-1/3) sqrt(Y/ρ)";
constexpr QuantityGroup group{"modes", "Vibrational modes at both ends of the spectrum."};

/// The modes at one end of the spectrum.
struct End {
  ModeEnd ended = ModeEnd::not_called;
  int attempts = 0;
  double residual = 0, relative_error = 0;
  std::vector<double> omega;
  Reasoned<> participation;
};
void describe_end(Fields& field, End& end, const Column& participation) {
  field.type("mode_set", "The modes at one end of the spectrum.");
  field("ended", end.ended,
        "Method that found the modes. `converged`: The Lanczos method, at the first attempt. `retried`: The Lanczos "
        "method, with another shift or a larger subspace. `dense_fallback`: A dense solver. `failed`: No method found "
        "the modes. `not_called`: The computation was not started.");
  field("attempts", end.attempts, "Number of attempts of the Lanczos method.");
  field("residual", end.residual, "Largest value of ‖Du − λu‖/λ_max for these modes.");
  field("relative_error", end.relative_error, "Upper bound of the relative error of the eigenvalues λ.");
  field("omega", end.omega,
        "Frequencies ω = √λ of the modes, ascending, in units of V_p^(-1/3)·√(Y/ρ). Zero and negative modes are left "
        "out.")
      .range(not_negative)
      .detail();
  field("participation", end.participation,
        "Mean participation ratio of these modes. The ratio is 1 if all particles have the same amplitude, and 1/N if "
        "only one particle moves.")
      .column(participation);
}

struct Density {
  std::vector<double> log10_omega, density, cumulative;
};
void describe(Fields& field, Density& density) {
  field("log10_omega", density.log10_omega, "Edges of the bins of log10 ω, ascending.").detail();
  field("density", density.density, "Share of all modes in each bin, divided by the width of the bin.").detail();
  field("cumulative", density.cumulative,
        "Share of all modes with frequencies below each edge. Zero and negative modes are included.")
      .detail();
}

struct Modes {
  Verdict verdict = Verdict::not_called;
  int zero = 0, negative = 0, positive = 0;
  double zero_tolerance = 0;
  std::vector<NearRattler> near_rattlers;
  double lambda_max = 0;
  Reasoned<> omega_l, omega_h;
  End lowest, highest;
  Reasoned<> face_face_amplitude, face_face_particles;
  std::optional<Reasoned<Density>> density_of_states;
};

void describe_ends(Fields& field, Modes& modes) {
  const std::string ratio =
      " The key `modes` of the manifest sets their number, by default 50. The ratio is 1 if all particles have the "
      "same amplitude, and 1/N if only one particle moves.";
  const Column p_l{"p_l", group, "p_l",
                   "Mean participation ratio of the lowest modes, without the three translations." + ratio, 2};
  const Column p_h{"p_h", group, "p_h", "Mean participation ratio of the highest modes." + ratio, 2};
  field.nested(
      "lowest", [&modes, p_l](Fields& inner) { describe_end(inner, modes.lowest, p_l); },
      "The lowest modes, without the three translations. Their number is `spec.modes`.");
  field.nested(
      "highest", [&modes, p_h](Fields& inner) { describe_end(inner, modes.highest, p_h); },
      "The highest modes. Their number is `spec.modes`.");
}

void describe(Fields& field, Modes& modes) {
  field("verdict", modes.verdict,
        "Stability of the state. `stable`: Three zero modes and no negative mode. `marginal`: More than three zero "
        "modes and no negative mode. `unstable`: At least one negative mode. `undetermined`: The modes could not be "
        "counted.");
  field("zero", modes.zero, "Number of zero modes, including the three translations.")
      .column({"zero_modes", group, "n_0", "", 1});
  field("negative", modes.negative, "Number of negative modes.").column({"negative_modes", group, "n_-", "", 1});
  field("positive", modes.positive, "Number of modes that are neither zero modes nor negative modes.");
  field("zero_tolerance", modes.zero_tolerance,
        "An eigenvalue λ counts as zero if |λ| is at most this value, in units of (Y/ρ)·V_p^(-2/3).");
  field("near_rattlers", modes.near_rattlers, "List of the near-rattlers.");
  field("lambda_max", modes.lambda_max, "Largest eigenvalue of D, in units of (Y/ρ)·V_p^(-2/3).");
  field("omega_l", modes.omega_l,
        "Mean frequency ω of the lowest modes, without the three translations. The key `modes` of the manifest sets "
        "their number, by default 50. The value is null if one of these modes is a zero or negative mode.")
      .unit(frequency)
      .column({"omega_l", group, "\\langle\\omega_l\\rangle"});
  field("omega_h", modes.omega_h,
        "Mean frequency ω of the highest modes. The key `modes` of the manifest sets their number, by default 50.")
      .unit(frequency)
      .column({"omega_h", group, "\\langle\\omega_h\\rangle"});
  describe_ends(field, modes);
  field("face_face_amplitude", modes.face_face_amplitude,
        "Share of the squared amplitude that belongs to particles with a face-face contact, averaged over the highest "
        "modes; null if the fit of θ_ff or of θ_ef found no cut-off.")
      .column({"face_face_amplitude", group, "a_{ff}", "", 2});
  field("face_face_particles", modes.face_face_particles,
        "Number of particles that have a face-face contact, divided by N; null if the fit of θ_ff or of θ_ef found no "
        "cut-off.")
      .column({"face_face_particles", group, "n_{ff}", "", 2});
  field("density_of_states", modes.density_of_states,
        "Density of states as a function of log10 ω, from all modes. The field is present only in the state nearest "
        "jamming, and only if N is at most 150.");
}

struct State {
  Modes modes;
};
void describe(Fields& field, State& state) {
  field("modes", state.modes,
        "Vibrational modes: eigenvectors u of the dynamical matrix D, with D u = ω² u. Each particle has the "
        "coordinates (x, R·θ).");
}

struct Scalings {
  Scaling omega_l, omega_h;
};
void describe(Fields& field, Scalings& scaling) {
  add_scaling(field, "omega_l", scaling.omega_l, "omega_l", "{\\omega_l}", "ω_l",
              "Power law of `omega_l`, the mean frequency of the lowest modes.");
  add_scaling(field, "omega_h", scaling.omega_h, "omega_h", "{\\omega_h}", "ω_h",
              "Power law of `omega_h`, the mean frequency of the highest modes.");
}

struct Replicate {
  Scalings scaling;
};
void describe(Fields& field, Replicate& replicate) {
  const auto inside = [&replicate](Fields& inner) {
    inner("scaling", replicate.scaling, "Power laws ω ∝ Δφ^x of the mean frequencies.");
  };
  field.nested("modes", inside, "Power laws of the mode frequencies as functions of Δφ.");
}

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

End end_record(const ModeSet& modes, double tolerance) {
  End end{modes.ended, modes.attempts, modes.residual, modes.relative_error, {}, {{}, "no modes"}};
  for (const double value : modes.eigenvalues) {
    if (value > tolerance) end.omega.push_back(std::sqrt(value));
  }
  if (modes.size() > 0) end.participation.value = participation_ratios(modes).mean();
  return end;
}

/// Adds the share of the amplitude of the highest modes that is on particles with a face-face contact.
void add_share(Modes& record, const ModeSet& highest, const ClassifiedContacts& classified, int particles) {
  std::optional<AmplitudeShare> share;
  const auto why = undecided(classified.analysis);
  if (!why) {
    std::vector<char> marked(static_cast<std::size_t>(particles), 0);
    for (const auto& pair : bonds_of(classified.contacts, classified.analysis.classes))
      marked[static_cast<std::size_t>(pair.a)] = marked[static_cast<std::size_t>(pair.b)] = 1;
    share = amplitude_share(highest, marked);
  }
  const auto [amplitude, with_contact] = share.value_or(AmplitudeShare{});
  record.face_face_amplitude = given(share.has_value(), amplitude, why.value_or("no modes"));
  record.face_face_particles = given(share.has_value(), with_contact, why.value_or("no modes"));
}

Modes mode_record(const Vibrations& vibrations) {
  const auto& stability = vibrations.stability;
  constexpr std::string_view none = "no modes, or one without a frequency";
  Modes record;
  record.verdict = stability.verdict;
  record.zero = stability.zero;
  record.negative = stability.negative;
  record.positive = stability.positive;
  record.zero_tolerance = stability.tolerance;
  record.near_rattlers = stability.near_rattlers;
  record.lambda_max = vibrations.ends.lambda_max;
  record.omega_l = reasoned(vibrations.omega_l, none);
  record.omega_h = reasoned(vibrations.omega_h, none);
  record.lowest = end_record(vibrations.ends.lowest, stability.tolerance);
  record.highest = end_record(vibrations.ends.highest, stability.tolerance);
  return record;
}

Reasoned<Density> density_record(const BlockMatrix& matrix, double tolerance) {
  const auto density = density_of_states(dense_modes(matrix).eigenvalues, tolerance);
  if (!density) return {std::nullopt, "no two frequencies differ"};
  const auto list = [](const Eigen::VectorXd& x) { return std::vector<double>(x.begin(), x.end()); };
  return {Density{list(density->edges), list(density->density), list(density->cumulative)}, ""};
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
    State state{mode_record(vibrations)};
    add_share(state.modes, vibrations.ends.highest, classified_contacts(packing, energy), packing.size());
    if (k == nearest && packing.size() <= all_modes_up_to)
      state.modes.density_of_states = density_record(matrix, vibrations.stability.tolerance);
    lowest.push_back(vibrations.omega_l);
    highest.push_back(vibrations.omega_h);
    if (vibrations.stability.verdict != Verdict::stable && measurement.flags.empty())
      measurement.flags.emplace_back(to_string(Flag::not_stable));
    measurement.states.push_back(written(state));
  }
  measurement.replicate = written(Replicate{{scaling_of(jam, lowest), scaling_of(jam, highest)}});
  return measurement;
}

constexpr std::array flags{Flag::not_stable};

}  // namespace

const MeasureDefinition measures::modes{.state = part_of<State>(),
                                        .replicate = part_of<Replicate>(),
                                        .measure = measure_modes,
                                        .flags = flags,
                                        .needs_minima = true};

}  // namespace isojam
