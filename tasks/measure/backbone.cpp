#include "engine/vibration/backbone.hpp"

#include "engine/rigidity/rigidity.hpp"
#include "engine/vibration/mode_statistics.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

// Measures the packing without its near-rattlers: contacts, modes, bulk modulus and rank of the remaining particles. In
// the whole packing, a single near-rattler can make modes and moduli undefined.

constexpr QuantityGroup group{"backbone", "The packing without near-rattlers: contacts, vibrations and constraints."};

struct MissingRank {
  Reasoned<int> missing, constraints, rank;
  Reasoned<> least_kept, largest_dropped;
};
/// `condition` states which constraints there are.
void describe_rank(Fields& field, MissingRank& rank, const std::string& name, const std::string& latex,
                   const std::string& condition) {
  field.type("missing_rank", "Number, rank and missing rank of the constraints of the backbone.");
  field("missing", rank.missing,
        "Missing rank: 6n − 3 minus the rank, where n is the number of particles in the backbone.")
      .range({-3, count_range.high})
      .column({name, group, latex,
               "Missing rank of the backbone, 6n − 3 − rank, if " + condition +
                   "; n is the number of particles of the backbone.",
               1});
  field("constraints", rank.constraints, "Number of constraints, the rows of the rigidity matrix.");
  field("rank", rank.rank, "Number of independent constraints, the rank of the rigidity matrix.");
  field("least_kept", rank.least_kept,
        "Smallest singular value that counts as nonzero. It is an upper limit, accurate to a few per cent.");
  field("largest_dropped", rank.largest_dropped, "Largest singular value that counts as zero.");
}

struct BackboneRecord {
  std::size_t removed = 0;
  std::vector<int> particles;
  int rounds = 0;
  Reasoned<> Z;
  MissingRank normals, classes;
  Verdict verdict = Verdict::not_called;
  Reasoned<> zero, negative, zero_tolerance, omega_l, residual, K;
};

void describe_contacts(Fields& field, BackboneRecord& backbone) {
  field("removed", backbone.removed, "Number of particles that were removed to obtain the backbone.")
      .column({"backbone_removed", group, "n_{removed}"});
  field("particles", backbone.particles, "Indices of the removed particles, ascending.").detail();
  field("rounds", backbone.rounds, "Number of rounds in which near-rattlers were removed.");
  field("Z", backbone.Z,
        "Contact number of the backbone: number of contacts per particle; each contact counts for both of its "
        "particles.")
      .unit("per particle")
      .column({"backbone_Z", group, "Z^{bb}"});
  const auto add = [&](const std::string& key, MissingRank& rank, const std::string& name, const std::string& latex,
                       const std::string& condition, const std::string& more) {
    field.nested(
        key, [=, &rank](Fields& inner) { describe_rank(inner, rank, name, latex, condition); },
        "Missing rank of the backbone if " + condition + "." + more);
  };
  add("normals", backbone.normals, "backbone_missing_normals", "m_n^{bb}",
      "the only constraint of a contact is its normal", "");
  add("classes", backbone.classes, "backbone_missing", "m_c^{bb}",
      "a face-face contact has three constraints, an edge-face contact two and a lower-order contact one",
      " The class of a contact is its class in the whole packing.");
}

void describe(Fields& field, BackboneRecord& backbone) {
  describe_contacts(field, backbone);
  field("verdict", backbone.verdict,
        "Stability of the backbone. `stable`: Three zero modes and no negative mode. `marginal`: More than three zero "
        "modes and no negative mode. `unstable`: At least one negative mode. `undetermined`: The modes could not be "
        "counted. `not_called`: No particle is left.");
  field("zero", backbone.zero, "Number of zero modes of the backbone, including the three translations.")
      .range(not_negative)
      .column({"backbone_zero", group, "n_0^{bb}"});
  field("negative", backbone.negative, "Number of negative modes of the backbone.")
      .range(not_negative)
      .column({"backbone_negative", group, "n_-^{bb}"});
  field("zero_tolerance", backbone.zero_tolerance,
        "An eigenvalue λ counts as zero if |λ| is at most this value, in units of (Y/ρ)·V_p^(-2/3).");
  field("omega_l", backbone.omega_l,
        "Mean frequency ω of the lowest modes of the backbone, without the three translations. The key `modes` of the "
        "manifest sets their number, by default 50. The value is null if one of these modes is a zero or negative "
        "mode.")
      .unit("V_p^(-1/3) sqrt(Y/ρ)")
      .column({"backbone_omega_l", group, "\\langle\\omega_l\\rangle^{bb}"});
  field("residual", backbone.residual,
        "Residual of the backbone. It is greater than the residual of the whole packing if the removed particles "
        "carried forces.");
  field("K", backbone.K,
        "Bulk modulus K = V d²E/dV² of the backbone, where V is the volume of the whole cell. Null if particles were "
        "removed and the residual of the backbone is above 1e-3, or if the Hessian of the backbone is not positive "
        "definite apart from translations.")
      .unit("Y")
      .column({"backbone_K", group, "K^{bb}"});
}

struct State {
  BackboneRecord backbone;
};
void describe(Fields& field, State& state) {
  field("backbone", state.backbone,
        "Backbone: the packing after its near-rattlers were removed, repeatedly, until no near-rattler was left. The n "
        "remaining particles keep their positions, in the same cell.");
}

MissingRank rank_of(const RigidityMatrix& matrix) {
  const auto found = analyse_rigidity(matrix);
  return {{found.floppy - 3, ""},
          {found.constraints, ""},
          {found.rank, ""},
          {found.least_kept, ""},
          {found.largest_dropped, ""}};
}

MissingRank no_rank(std::string_view why) {
  const Reasoned<int> none{std::nullopt, std::string(why)};
  const Reasoned<> no_value{std::nullopt, std::string(why)};
  return {none, none, none, no_value, no_value};
}

/// Adds contacts and ranks. Each contact keeps the class that it has in the whole packing, because the cut-offs are
/// fitted to all contacts.
void add_contacts(BackboneRecord& record, const Backbone& backbone, const ClassifiedContacts& whole, int particles) {
  const auto within = contacts_within(whole.contacts, backbone.kept, particles);
  record.Z.value = 2 * static_cast<double>(within.contacts.size()) / static_cast<double>(backbone.kept.size());
  record.normals = rank_of(normal_constraints(backbone.packing, within.contacts));
  if (const auto why = undecided(whole.analysis)) {
    record.classes = no_rank(*why);
    return;
  }
  std::vector<Alignment> alignments;
  std::vector<ContactClass> classes;
  for (const auto place : within.places) {
    alignments.push_back(whole.alignments[place]);
    classes.push_back(whole.analysis.classes[place]);
  }
  record.classes = rank_of(class_constraints(backbone.packing, within.contacts, alignments, classes));
}

void add_modes(BackboneRecord& record, const Backbone& backbone) {
  const auto& stability = backbone.stability;
  const bool known = stability.verdict != Verdict::undetermined;
  constexpr std::string_view no_verdict = "inertia could not be had";
  record.verdict = stability.verdict;
  record.zero = given<double>(known, stability.zero, no_verdict);
  record.negative = given<double>(known, stability.negative, no_verdict);
  record.zero_tolerance.value = stability.tolerance;
  record.omega_l =
      reasoned(mean_frequency(backbone.ends.lowest, stability.tolerance), "no modes, or one without a frequency");
}

/// Largest residual of the remaining particles that counts as balanced. Then the removed particles carried almost no
/// force.
constexpr double balanced = 1e-3;

/// The bulk modulus. It is defined only for an equilibrium, so it is absent if the removed particles carried force.
Reasoned<> bulk_modulus(const Backbone& backbone) {
  if (!backbone.removed.empty() && !(backbone.here.residual <= balanced))
    return {std::nullopt, "particles that were removed bore force: the rest does not balance"};
  const auto tensor = elastic_tensor(backbone);
  return given(tensor.has_value(), tensor ? tensor->bulk_modulus() : 0,
               "the Hessian is not positive definite: no response is defined");
}

void add_nothing(BackboneRecord& record) {
  constexpr std::string_view nothing_left = "no particle is held";
  record.normals = record.classes = no_rank(nothing_left);
  for (auto* value : {&record.Z, &record.zero, &record.negative, &record.zero_tolerance, &record.omega_l,
                      &record.residual, &record.K})
    value->reason = nothing_left;
}

Measurement measure_backbone(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const auto backbone = backbone_of(packing, {.lowest = options.modes, .highest = options.modes}, state_precision);
    State state;
    state.backbone.removed = backbone.removed.size();
    state.backbone.particles = backbone.removed;
    state.backbone.rounds = backbone.rounds;
    if (backbone.kept.empty()) {
      add_nothing(state.backbone);
    } else {
      add_contacts(state.backbone, backbone, classified_contacts(packing, energy), packing.size());
      add_modes(state.backbone, backbone);
      state.backbone.residual.value = backbone.here.residual;
      state.backbone.K = bulk_modulus(backbone);
    }
    measurement.states.push_back(written(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::backbone{
    .state = part_of<State>(), .measure = measure_backbone, .needs_minima = true};

}  // namespace isojam
