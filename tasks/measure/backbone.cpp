#include "engine/vibration/backbone.hpp"

#include "engine/rigidity/rigidity.hpp"
#include "engine/vibration/mode_statistics.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Measures the packing without its near-rattlers: contacts, modes, bulk modulus and rank of the remaining particles. In
// the whole packing, a single near-rattler can make modes and moduli undefined.

constexpr QuantityGroup group{"backbone", "The packing without near-rattlers: contacts, vibrations and constraints."};
constexpr std::string_view frequency = "V_p^(-1/3) sqrt(Y/ρ)";
constexpr Quantity removed{"backbone_removed", "/backbone/removed", group, "1", "n_{removed}"};
constexpr Quantity Z{"backbone_Z", "/backbone/Z", group, "per particle", "Z^{bb}"};
constexpr Quantity zero{"backbone_zero", "/backbone/zero", group, "1", "n_0^{bb}"};
constexpr Quantity negative{"backbone_negative", "/backbone/negative", group, "1", "n_-^{bb}"};
constexpr Quantity omega_l{"backbone_omega_l", "/backbone/omega_l", group, frequency, "\\langle\\omega_l\\rangle^{bb}"};
constexpr Quantity K{"backbone_K", "/backbone/K", group, "Y", "K^{bb}"};
constexpr Quantity missing_normals{"backbone_missing_normals", "/backbone/normals/missing", group, "1", "m_n^{bb}"};
constexpr Quantity missing{"backbone_missing", "/backbone/classes/missing", group, "1", "m_c^{bb}"};
constexpr std::array quantities{removed, Z, zero, negative, omega_l, K, missing_normals, missing};

constexpr std::string_view nothing_left = "no particle is held";

void put_rank_of(Json& state, const Quantity& missing_rank, const RigidityMatrix& matrix) {
  const auto rigidity = analyse_rigidity(matrix);
  put(state, missing_rank, rigidity.floppy - 3);
  Json& json = place_of(state, missing_rank).object;
  json["constraints"] = rigidity.constraints;
  json["rank"] = rigidity.rank;
  put_number(json, "least_kept", rigidity.least_kept);
  put_number(json, "largest_dropped", rigidity.largest_dropped);
}

void put_no_rank(Json& state, const Quantity& missing_rank, std::string_view why) {
  put(state, missing_rank, std::nullopt, why);
  Json& json = place_of(state, missing_rank).object;
  for (const auto* key : {"constraints", "rank", "least_kept", "largest_dropped"}) put_absent(json, key, why);
}

/// Adds contacts and ranks. Each contact keeps the class that it has in the whole packing, because the cut-offs are
/// fitted to all contacts.
void put_contacts(Json& state, const Backbone& backbone, const ClassifiedContacts& whole, int particles) {
  const auto within = contacts_within(whole.contacts, backbone.kept, particles);
  put(state, Z, 2 * static_cast<double>(within.contacts.size()) / static_cast<double>(backbone.kept.size()));
  put_rank_of(state, missing_normals, normal_constraints(backbone.packing, within.contacts));
  if (const auto why = undecided(whole.analysis)) return put_no_rank(state, missing, *why);
  std::vector<Alignment> alignments;
  std::vector<ContactClass> classes;
  for (const auto place : within.places) {
    alignments.push_back(whole.alignments[place]);
    classes.push_back(whole.analysis.classes[place]);
  }
  put_rank_of(state, missing, class_constraints(backbone.packing, within.contacts, alignments, classes));
}

void put_modes(Json& state, const Backbone& backbone) {
  const auto& stability = backbone.stability;
  const bool known = stability.verdict != Verdict::undetermined;
  const auto count = [&](int n) { return known ? std::optional<double>(n) : std::nullopt; };
  constexpr std::string_view no_verdict = "inertia could not be had";
  state["backbone"]["verdict"] = to_string(stability.verdict);
  put(state, zero, count(stability.zero), no_verdict);
  put(state, negative, count(stability.negative), no_verdict);
  put_number(state["backbone"], "zero_tolerance", stability.tolerance);
  put(state, omega_l, mean_frequency(backbone.ends.lowest, stability.tolerance),
      "no modes, or one without a frequency");
}

/// Largest residual of the remaining particles that counts as balanced. Then the removed particles carried almost no
/// force.
constexpr double balanced = 1e-3;

/// Adds the bulk modulus. It is defined only for an equilibrium, so it is absent if the removed particles carried
/// force.
void put_response(Json& state, const Backbone& backbone) {
  const double residual = backbone.here.residual;
  put_number(state["backbone"], "residual", residual);
  if (!backbone.removed.empty() && !(residual <= balanced))
    return put(state, K, std::nullopt, "particles that were removed bore force: the rest does not balance");
  const auto tensor = elastic_tensor(backbone);
  put(state, K, tensor ? std::optional(tensor->bulk_modulus()) : std::nullopt,
      "the Hessian is not positive definite: no response is defined");
}

void put_nothing(Json& state) {
  put(state, Z, std::nullopt, nothing_left);
  put_no_rank(state, missing_normals, nothing_left);
  put_no_rank(state, missing, nothing_left);
  state["backbone"]["verdict"] = to_string(Verdict::not_called);
  for (const auto& quantity : {zero, negative, omega_l, K}) put(state, quantity, std::nullopt, nothing_left);
  for (const auto* key : {"zero_tolerance", "residual"}) put_absent(state["backbone"], key, nothing_left);
}

Measurement measure_backbone(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const auto backbone = backbone_of(packing, {.lowest = options.modes, .highest = options.modes}, state_precision);
    Json state;
    put(state, removed, static_cast<int>(backbone.removed.size()));
    state["backbone"]["particles"] = backbone.removed;
    state["backbone"]["rounds"] = backbone.rounds;
    if (backbone.kept.empty()) {
      put_nothing(state);
    } else {
      put_contacts(state, backbone, classified_contacts(packing, energy), packing.size());
      put_modes(state, backbone);
      put_response(state, backbone);
    }
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::backbone{.quantities = quantities, .measure = measure_backbone, .needs_minima = true};

}  // namespace isojam
