#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/analysis/alignment/random_alignment.hpp"
#include "engine/analysis/contacts.hpp"
#include "tasks/io/describe.hpp"
#include "tasks/measure/trough_parts.hpp"

// Fields of the measure `contacts`.

namespace isojam {

inline constexpr QuantityGroup kind_group{"kinds of a mixture", "Contact numbers of the particles of each kind."};

/// What is optional is absent if the fit found no cut-off.
struct FitRecord {
  FitVerdict verdict = FitVerdict::not_called;
  std::optional<double> cutoff, alpha, a_0, a_0_error, error;
};
inline void describe(Fields& field, FitRecord& fit) {
  field.type("fit",
             "Fit to the cumulative distribution (CDF) c(θ) of an alignment angle. The fit gives the cut-off of a "
             "contact class. If it found no cut-off, only `verdict` is present. Angles are in radians.");
  field("verdict", fit.verdict,
        "Result of the fit. `fitted`: A cut-off was found. `bimodal`: A cut-off was found, but the fitted function "
        "does not describe the CDF. `collapsed`: The CDF has no jump, so there is no cut-off. `alpha_out_of_range`: "
        "The jump of the CDF is not near zero, so there is no cut-off. `too_few`: There are too few angles for a fit. "
        "`not_called`: No fit was made.");
  field("cutoff", fit.cutoff,
        "Cut-off θ_cut: the upper end of the interval of angles in which the CDF is nearest to a_0.");
  field("alpha", fit.alpha, "Parameter α of the fitted function: the angle at which the function jumps.");
  field("a_0", fit.a_0, "Parameter a_0 of the fitted function: the height of the jump.");
  field("a_0_error", fit.a_0_error, "Standard error of a_0.");
  field("error", fit.error, "Squared deviation ∫ (c_f − c)² dθ of the fitted function c_f from the CDF c.");
}

struct CutoffRecords {
  FitRecord face_face_fit, edge_face_fit;
};
/// Contact numbers by fitted cut-offs.
struct KnownNumbers {
  double Z = 0;
  Reasoned<> Z_ff, Z_ef, Z_l, C;
};
inline void describe(Fields& field, KnownNumbers& kind) {
  field.type("kind",
             "Means over the particles of one kind of a mixture. The field `kind_1` belongs to the first kind in "
             "`spec.mixture`, `kind_2` to the second, and so on.");
  field("Z", kind.Z, "Contact number: number of contacts per particle of this kind.")
      .unit("per particle")
      .finite()
      .column({.name = "Z_*",
               .group = kind_group,
               .latex = "Z_*",
               .meaning = "Contact number of kind * of a mixture: number of contacts per particle of this kind. Kinds "
                          "are numbered in the order of the manifest.",
               .kinds = 2});
  field("Z_ff", kind.Z_ff,
        "Number of face-face contacts per particle of this kind; null if the fit of θ_ff found no cut-off.");
  field("Z_ef", kind.Z_ef,
        "Number of edge-face contacts per particle of this kind; null if the fit of θ_ff or of θ_ef found no cut-off.");
  field("Z_l", kind.Z_l,
        "Number of lower-order contacts per particle of this kind; null if the fit of θ_ff or of θ_ef found no "
        "cut-off.");
  field("C", kind.C,
        "Constraint number: number of constraints per particle of this kind; null if the fit of θ_ff or of θ_ef found "
        "no cut-off.");
}

struct ShapePairRecord {
  std::array<std::string, 2> solids;
  long contacts = 1;
  CutoffRecords cutoffs;
};
inline void describe(Fields& field, ShapePairRecord& pair) {
  field("solids", pair.solids, "Names of the two solids.");
  field("contacts", pair.contacts, "Number of contacts between particles of these two shapes.")
      .range({1, count_range.high});
  auto& cutoffs = pair.cutoffs;
  field("face_face_fit", cutoffs.face_face_fit, "Fit to the distribution of θ_ff in these contacts.");
  field("edge_face_fit", cutoffs.edge_face_fit, "Fit to the distribution of θ_ef in these contacts.");
}

struct Partial {
  std::vector<std::vector<double>> Z;
};
inline void describe(Fields& field, Partial& partial) {
  field("Z_*_*", partial.Z, "Number of contacts with particles of the second kind, per particle of the first kind.")
      .unit("per particle")
      .range(not_negative)
      .finite()
      .column({.name = "Z_**",
               .group = kind_group,
               .latex = "Z_{**}",
               .meaning = "Number of contacts of a particle of kind * of a mixture with particles of kind *, averaged "
                          "over the particles of the first of these kinds.",
               .kinds = 2});
}

inline void describe(Fields& field, Randomness& random) {
  field.type("randomness",
             "Comparison of the number of alignment angles near 0 with the number that is expected for random "
             "contacts. Random contacts have random positions and orientations.");
  field("verdict", random.verdict,
        "Result of the comparison. `hyper_random`: There are significantly more angles near 0 than for random "
        "contacts. `random`: There is no significant difference. `sub_random`: There are significantly fewer angles "
        "near 0 than for random contacts. `too_few`: There are too few contacts for a significant result. "
        "`not_called`: No comparison was made.");
  field("angle", random.angle, "Upper end of the range of angles near 0, in radians.");
  field("below", random.below, "Number of contacts whose angle is in the range near 0.");
  field("expected", random.expected, "Number of contacts in this range that is expected for random contacts.");
  field("probability", random.probability,
        "Binomial probability that the number for random contacts is at least as far from `expected` as `below` is, in "
        "the same direction.");
}

struct Angles {
  Randomness face_face_random, edge_face_random;
  std::vector<double> face_face, edge_face;
};
inline void describe(Fields& field, Angles& angles) {
  field("face_face_random", angles.face_face_random,
        "Comparison of the angles θ_ff with those of random contacts in which a vertex touches a face.");
  field("edge_face_random", angles.edge_face_random,
        "Comparison of the angles θ_ef with those of random contacts in which a vertex touches a face.");
  field("face_face", angles.face_face, "Angles θ_ff of all contacts, ascending, in radians.")
      .range(not_negative)
      .detail();
  field("edge_face", angles.edge_face, "Angles θ_ef of all contacts, ascending, in radians.")
      .range(not_negative)
      .detail();
}

struct Contacts {
  KnownNumbers numbers;
  double Q6 = 0;
  CutoffRecords cutoffs;
  ContactNumbers fixed_cutoffs;
  int pooled_over = 1;
  std::vector<KnownNumbers> kinds;
  std::optional<std::vector<ShapePairRecord>> shape_pairs;
  std::optional<AngleBins> angle_bins;  ///< absent only in records that were made up
  Troughs trough;
  std::optional<Partial> partial;
  std::optional<Reasoned<>> mixing;
  std::optional<double> Z_grown, tension;
  std::optional<std::vector<std::array<int, 2>>> under_tension;
  std::optional<Angles> angles;
};
inline void describe_numbers(Fields& field, Contacts& contacts) {
  auto& numbers = contacts.numbers;
  field("Z", numbers.Z,
        "Contact number: number of contacts per particle; each contact counts for both of its particles.")
      .unit("per particle")
      .column({"Z", main_group, "Z"});
  field("Q6", contacts.Q6, "Steinhardt's Q6 of the directions between the centres of touching particles.")
      .range({0, 1.000001})
      .finite();
  field("Z_ff", numbers.Z_ff, "Number of face-face contacts per particle; null if the fit of θ_ff found no cut-off.")
      .unit("per particle")
      .column({"Z_ff", main_group, "Z_{ff}"});
  field("Z_ef", numbers.Z_ef,
        "Number of edge-face contacts per particle; null if the fit of θ_ff or of θ_ef found no cut-off.")
      .unit("per particle")
      .column({"Z_ef", main_group, "Z_{ef}"});
  field("Z_l", numbers.Z_l,
        "Number of lower-order contacts per particle; null if the fit of θ_ff or of θ_ef found no cut-off.")
      .unit("per particle")
      .column({"Z_l", main_group, "Z_l"});
  field("C", numbers.C,
        "Constraint number C = 3 Z_ff + 2 Z_ef + Z_l: number of constraints per particle; each contact counts for both "
        "of its particles, so that an isostatic packing has C = 12. Null if the fit of θ_ff or of θ_ef found no "
        "cut-off.")
      .unit("per particle")
      .column({"C", main_group, "C"});
}

inline void describe_fixed(Fields& field, ContactNumbers& numbers) {
  const auto add = [&](const std::string& key, double& number, const std::string& latex, const std::string& what) {
    field(key, number, "Number of " + what + " per particle, averaged over the fixed cut-offs 5°, 15°, …, 55°.")
        .unit("per particle")
        .column({key + "_fixed", contact_group, latex + "^{fixed}", "", 1});
  };
  add("Z_ff", numbers.Z_ff, "Z_{ff}", "face-face contacts");
  add("Z_ef", numbers.Z_ef, "Z_{ef}", "edge-face contacts");
  add("Z_l", numbers.Z_l, "Z_l", "lower-order contacts");
  add("C", numbers.C, "C", "constraints");
}

inline void describe_cutoffs(Fields& field, Contacts& contacts) {
  auto& cutoffs = contacts.cutoffs;
  field("face_face_fit", cutoffs.face_face_fit,
        "Fit to the distribution of θ_ff. It gives the cut-off of face-face contacts.");
  field("edge_face_fit", cutoffs.edge_face_fit,
        "Fit to the distribution of θ_ef. It gives the cut-off of edge-face contacts.");
  field.nested(
      "fixed_cutoffs", [&contacts](Fields& inner) { describe_fixed(inner, contacts.fixed_cutoffs); },
      "Contact numbers and constraint number with fixed cut-offs instead of fitted ones. Each value is the "
      "mean of the results for the cut-offs 5°, 15°, …, 55°. Each cut-off is used for both θ_ff and θ_ef.");
  field("pooled_over", contacts.pooled_over,
        "Number of packings whose angles were combined to fit the cut-offs. With 1, only the angles of this packing "
        "were used.")
      .range({1, count_range.high});
}

inline void describe_cohesion(Fields& field, Contacts& contacts) {
  constexpr QuantityGroup group{"cohesion", "Contacts of the packing with cohesion at zero pressure."};
  field("Z_grown", contacts.Z_grown,
        "Number of grown contacts per particle: pairs of particles that attract each other. It includes all contacts. "
        "Only packings with cohesion at zero pressure have this field.")
      .unit("per particle")
      .range(not_negative)
      .finite()
      .column({.name = "Z_grown",
               .group = group,
               .latex = "Z_{grown}",
               .meaning = "Number of pairs that attract each other, per particle. Only packings with cohesion at zero "
                          "pressure have it.",
               .cohesive = true});
  field("tension", contacts.tension,
        "Share of the contacts that are under tension: the attraction between the particles exceeds their repulsion. "
        "Only packings with cohesion at zero pressure have this field.")
      .range({0, 1})
      .column({.name = "tension",
               .group = group,
               .latex = "P_{tension}",
               .meaning = "Share of the contacts that are under tension. Only packings with cohesion at zero pressure "
                          "have it.",
               .cohesive = true});
  field("under_tension", contacts.under_tension,
        "The contacts under tension: for each one, the indices of its two particles. Only packings with cohesion at "
        "zero pressure have this field.")
      .detail();
}

inline void describe(Fields& field, Contacts& contacts) {
  describe_numbers(field, contacts);
  describe_cutoffs(field, contacts);
  field("kind_*", contacts.kinds, "");
  field("shape_pairs", contacts.shape_pairs,
        "Cut-offs for each pair of shapes in a mixture; absent if all particles have the same shape.");
  field("angle_bins", contacts.angle_bins,
        "Numbers of contacts in bins of log10 θ, with θ in radians. Bin k contains the angles with k·`width` ≤ log10 θ "
        "< (k + 1)·`width`. The lowest bin, −240, also contains all smaller angles.");
  field("trough", contacts.trough, "Classes of the contacts with cut-offs in the troughs of the densities of log10 θ.");
  field("partial", contacts.partial,
        "Partial contact numbers of a mixture. `Z_i_j` is the number of contacts with particles of kind j, per "
        "particle of kind i. Absent if all particles are of one kind.");
  field("mixing", contacts.mixing,
        "Mixing: the share of contacts between different kinds, divided by its value if the ends of all contacts were "
        "paired at random. It is 1 in a random mixture, less if the kinds separate, and more if different kinds are "
        "neighbours. Null if all contacts are between particles of one kind; absent if all particles are of one kind.")
      .range(not_negative)
      .column({.name = "mixing",
               .group = kind_group,
               .latex = "M",
               .meaning = "Mixing of the kinds of a mixture: the share of contacts between different kinds, divided by "
                          "its value if the ends of all contacts were paired at random. It is 1 in a random mixture.",
               .kinds = 2});
  describe_cohesion(field, contacts);
  field("angles", contacts.angles,
        "Alignment angles of all contacts, and their comparison with random contacts. Only the state nearest jamming "
        "has this field.");
}

struct ContactsOfState {
  Contacts contacts;
};
inline void describe(Fields& field, ContactsOfState& state) {
  field("contacts", state.contacts, "Contact numbers, constraint numbers and cut-offs of the contact classes.");
}

/// The fields that follow from the angles and classes of the contacts. `trough` and `angle_bins` are not among them.
Contacts contact_record(const ContactAnalysis& analysis);
/// The flags of the measure `contacts` that the nearest state causes: classes_undecided or classes_doubtful, and
/// crystalline. See Flag.
std::vector<std::string> contact_flags(const ContactAnalysis& nearest);

struct CycleRecord {
  Reasoned<> Z, Z_ff;
};
inline void describe(Fields& field, CycleRecord& cycle) {
  field("Z", cycle.Z, "Contact number; null if the state was not saved.");
  field("Z_ff", cycle.Z_ff,
        "Number of face-face contacts per particle; null if the state was not saved, or if the fit found no cut-off.");
}

struct CycleRecords {
  std::vector<CycleRecord> cycles;
};
inline void describe(Fields& field, CycleRecords& contacts) {
  field("cycles", contacts.cycles, "Contact numbers of the last state of each training cycle.");
}

struct ContactsOfReplicate {
  std::optional<CycleRecords> contacts;
};
inline void describe(Fields& field, ContactsOfReplicate& replicate) {
  field("contacts", replicate.contacts, "Contact numbers of the training cycles; absent if there are none.");
}

}  // namespace isojam
