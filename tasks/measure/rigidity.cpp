#include "engine/packing/energy.hpp"
#include "tasks/measure/rank_parts.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tasks/measure/trough_parts.hpp"

namespace isojam {
namespace {

struct ScaledCutoffs {
  double factor = 0;
  int constraints = 0, rank = 0, self_stress = 0, floppy = 0;
};
void describe(Fields& field, ScaledCutoffs& scaled) {
  field("factor", scaled.factor, "Factor by which the fitted cut-offs are multiplied.").range(positive).finite();
  field("constraints", scaled.constraints, "Number of constraints, the rows of the rigidity matrix.");
  field("rank", scaled.rank, "Number of independent constraints, the rank of the rigidity matrix.");
  field("self_stress", scaled.self_stress,
        "Number of states of self-stress, which is the number of constraints minus the rank.");
  field("floppy", scaled.floppy,
        "Number of floppy motions, including the three translations. It is 6N minus the rank.");
}

struct Ranks {
  Rank normals, classes;
  std::vector<ScaledCutoffs> scaled_cutoffs;
  Rank trough;
};
void describe(Fields& field, Ranks& ranks) {
  const std::string if_classes =
      "if a face-face contact has three constraints, an edge-face contact two and a lower-order contact one.";
  const auto add = [&](const std::string& key, Rank& rank, const std::string& letter, const std::string& condition,
                       const char* meaning) {
    field.nested(
        key, [=, &rank](Fields& inner) { describe_rank(inner, rank, key, letter, condition); }, meaning);
  };
  add("normals", ranks.normals, "n", "if the only constraint of a contact is its normal.",
      "Rigidity matrix in which the only constraint of a contact is its normal.");
  add("classes", ranks.classes, "c", if_classes,
      "Rigidity matrix in which a face-face contact has three constraints, an edge-face contact two and a lower-order "
      "contact one.");
  field("scaled_cutoffs", ranks.scaled_cutoffs,
        "Results for the rigidity matrix of the field `classes` after both fitted cut-offs are multiplied by a factor. "
        "The list is empty if a fit found no cut-off, or if the particles have several shapes.");
  add("trough", ranks.trough, "t", if_classes + " The cut-offs are in the troughs of the densities of log10 θ.",
      "Like `classes`, but the classes have their cut-offs in the troughs of the densities of log10 θ.");
}

struct State {
  Ranks rigidity;
};
void describe(Fields& field, State& state) {
  field("rigidity", state.rigidity, "Rank of the rigidity matrix, for several definitions of the constraints.");
}

/// Both fitted cut-offs are multiplied by these factors, to show how the rank depends on them.
constexpr std::array cutoff_factors{.5, 2.0};

/// Results with scaled cut-offs. Empty for mixtures of several shapes, because each pair of shapes has its own
/// cut-offs.
std::vector<ScaledCutoffs> scaled_cutoffs(const Packing& packing, const ClassifiedContacts& classified) {
  std::vector<ScaledCutoffs> list;
  const ContactAnalysis& analysis = classified.analysis;
  if (!analysis.pairs.empty() || undecided(analysis)) return list;
  for (const double factor : cutoff_factors) {
    const auto classes =
        classify(classified.alignments, factor * analysis.face_face.cutoff, factor * analysis.edge_face.cutoff);
    const auto rigidity =
        analyse_rigidity(class_constraints(packing, classified.contacts, classified.alignments, classes));
    list.push_back({factor, rigidity.constraints, rigidity.rank, rigidity.self_stress, rigidity.floppy});
  }
  return list;
}

/// The rank for the classes by troughs.
Rank rank_by_trough(const Packing& packing, const ClassifiedContacts& classified) {
  const TroughCutoffs cutoffs = trough_cutoffs(histogram_of(classified));
  if (const auto why = undecided(cutoffs)) return no_rank(*why);
  const auto classes = classify(classified.alignments, angle_bin_edge(cutoffs.face_face.cutoff),
                                angle_bin_edge(cutoffs.edge_face.cutoff));
  return rank_of(class_constraints(packing, classified.contacts, classified.alignments, classes));
}

Measurement measure_rigidity(const JamResult& jam, const MeasureOptions&) {
  Measurement measurement;
  PackingEnergy energy;
  for (const Packing& packing : jam.states) {
    const auto classified = classified_contacts(packing, energy);
    const auto& contacts = classified.contacts;
    const auto why = undecided(classified.analysis);
    State state{
        {rank_of(normal_constraints(packing, contacts)),
         why ? no_rank(*why)
             : rank_of(class_constraints(packing, contacts, classified.alignments, classified.analysis.classes)),
         scaled_cutoffs(packing, classified), rank_by_trough(packing, classified)}};
    measurement.states.push_back(written(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::rigidity{.state = part_of<State>(), .measure = measure_rigidity};

}  // namespace isojam
