#pragma once

#include <optional>
#include <vector>

#include "engine/analysis/contacts.hpp"
#include "tasks/io/describe.hpp"

// Fields of the measure `prestress`.

namespace isojam {

inline constexpr QuantityGroup prestress_group{
    "prestress", "Constraints from stiff contacts, and vibrations with and without contact forces."};

/// A rank, or one that is optional.
template <class Number, class Count>
struct StiffRank {
  Number missing{};
  Count constraints{}, rank{};
  Number tolerance{}, least_kept{}, largest_dropped{};
};
template <class Rank>
inline void add_rank(Fields& field, Rank& rank, const Column& missing) {
  field("missing", rank.missing, "Missing rank per particle, (6N − 3 − rank)/N.")
      .unit("per particle")
      .finite()
      .column(missing);
  field("constraints", rank.constraints, "Number of constraints, the rows of the rigidity matrix.");
  field("rank", rank.rank, "Number of independent constraints, the rank of the rigidity matrix.");
  field("tolerance", rank.tolerance,
        "A singular value of the rigidity matrix counts as zero if it is at most this value.");
  field("least_kept", rank.least_kept,
        "Smallest singular value that counts as nonzero. It is an upper limit, accurate to a few per cent.");
  field("largest_dropped", rank.largest_dropped, "Largest singular value that counts as zero.");
}

struct StiffCount {
  double threshold = 0, C = 0;
  StiffRank<std::optional<double>, std::optional<int>> rank;
  std::optional<int> self_stress;
};
inline void describe(Fields& field, StiffCount& count) {
  field.type("stiff_count",
             "Number of constraints for one threshold of s. With a threshold other than 10, only the fields "
             "`threshold` and `C` are present.");
  field("threshold", count.threshold, "Threshold of s: a tilt with a larger s counts as a constraint.")
      .range(positive)
      .finite();
  field("C", count.C,
        "Constraint number: number of constraints per particle; each contact counts for both of its particles.")
      .range(not_negative)
      .finite();
  add_rank(field, count.rank, {});
  field("self_stress", count.self_stress,
        "Number of states of self-stress, which is the number of constraints minus the rank.");
}

struct TiltsOfClass {
  ContactClass which = ContactClass::face_face;
  int contacts = 0, stiff_tilts = 0;
};
inline void describe(Fields& field, TiltsOfClass& tilts) {
  field("class", tilts.which, "Contact class, according to the fitted cut-offs.");
  field("contacts", tilts.contacts, "Number of contacts of this class.");
  field("stiff_tilts", tilts.stiff_tilts, "Number of stiff tilts of all contacts of this class.");
}

struct SecondByShare {
  double normals_below = 0;
  Reasoned<> modes;
};
inline void describe(Fields& field, SecondByShare& second) {
  field("normals_below", second.normals_below, "Limit of the share.").range({0, 1, true}).finite();
  field("modes", second.modes,
        "Number of modes in which the share of the normals is below the limit; null in the same case as "
        "`held_by_second`.")
      .range(not_negative);
}

struct PrestressByThreshold {
  double threshold = 0;
  Reasoned<> modes;
};
inline void describe(Fields& field, PrestressByThreshold& prestress) {
  field("threshold", prestress.threshold, "Threshold of s.").range(positive).finite();
  field("modes", prestress.modes,
        "Number of modes in which the normals and the tilts with s above this threshold together contribute less than "
        "half of λ; null in the same case as `held_by_prestress`.")
      .range(not_negative);
}

struct StiffnessOfModes {
  double worst_sum = 0;  ///< largest relative deviation of the sum of contributions from λ
  std::vector<double> lambda, normal, tilt;
};
struct HeldModes {
  Reasoned<> held_by_second, held_by_prestress;
  std::vector<SecondByShare> second_by_share;
  std::vector<PrestressByThreshold> prestress_by_threshold;
  Eigen::Index looked_at = 0, unresolved = 0;
  Reasoned<> prestress_lambda;
  StiffnessOfModes listed;
};
inline void describe_lists(Fields& field, StiffnessOfModes& modes) {
  field("lambda", modes.lambda, "Stiffness λ of the lowest analysed modes, at most 50, ascending.").detail();
  field("normal", modes.normal, "Share of the normals in the stiffness, for each mode of the list `lambda`.").detail();
  field("tilt", modes.tilt,
        "Share of the stiff tilts in the stiffness, for each mode of the list `lambda`. The rest is the share of the "
        "prestress.")
      .detail();
}
inline void describe(Fields& field, HeldModes& modes) {
  field.type("held_modes",
             "Contributions of the normals, the stiff tilts and the prestress to the stiffness λ of the modes. If N is "
             "at most 150, all modes are analysed. Otherwise, only the lowest modes are analysed; their number is "
             "`spec.modes`.");
  field("held_by_second", modes.held_by_second,
        "Number of modes in which the normals contribute less than half of the stiffness λ. If N is above 150, only "
        "the lowest modes are analysed; the value is null if all of these satisfy the condition, because other modes "
        "may satisfy it too.")
      .range(not_negative)
      .column({"held_by_second", prestress_group, "n_2", "", 2});
  field("held_by_prestress", modes.held_by_prestress,
        "Number of modes in which the normals and the stiff tilts together contribute less than half of the stiffness "
        "λ. If N is above 150, only the lowest modes are analysed; the value is null if all of these satisfy the "
        "condition, because other modes may satisfy it too.")
      .range(not_negative)
      .column({"held_by_prestress", prestress_group, "n_p", "", 2});
  field("second_by_share", modes.second_by_share,
        "For several limits, the number of modes in which the share of the normals in the stiffness λ is below the "
        "limit.")
      .detail();
  field("prestress_by_threshold", modes.prestress_by_threshold,
        "For several thresholds, the number of modes in which the normals and the tilts with s above the threshold "
        "together contribute less than half of the stiffness λ.")
      .detail();
  field("looked_at", modes.looked_at, "Number of modes that were analysed.");
  field("unresolved", modes.unresolved,
        "Number of analysed modes that are zero or negative modes. All other numbers and lists of this object, except "
        "`looked_at`, leave these modes out.");
  field("worst_sum", modes.listed.worst_sum,
        "Largest relative difference between λ of a mode and the sum of its three contributions.");
  field("prestress_lambda", modes.prestress_lambda,
        "Geometric mean of λ over the modes that are counted in `held_by_prestress`; null if there is none.");
  describe_lists(field, modes.listed);
}

struct Prestress {
  double C_s = 0, missing = 0;
  int self_stress = 0;
  std::vector<StiffCount> thresholds;
  std::vector<TiltsOfClass> by_class;
  StiffRank<double, int> normals;
  long without_second = 0;
  HeldModes modes;
  std::optional<std::vector<double>> s_normal, s_tilt;
};
inline void describe_counts(Fields& field, Prestress& prestress) {
  field("C_s", prestress.C_s,
        "Constraint number C_s: number of constraints per particle, if the constraints of a contact are its normal and "
        "its stiff tilts; each contact counts for both of its particles. If C_s = 12, there are as many constraints as "
        "degrees of freedom.")
      .unit("per particle")
      .column({"C_s", prestress_group, "C_s"});
  field("missing", prestress.missing,
        "Missing rank per particle, (6N − 3 − rank)/N, if the constraints of a contact are its normal and its stiff "
        "tilts.")
      .unit("per particle")
      .column({"missing_s", prestress_group, "m_s"});
  field("self_stress", prestress.self_stress,
        "Number of states of self-stress if the constraints of a contact are its normal and its stiff tilts.")
      .column({"self_stress_s", prestress_group, "s_s", "", 1});
  field("thresholds", prestress.thresholds,
        "Numbers of constraints for several thresholds. A tilt counts as a constraint if its relative stiffness s = "
        "κR/f is above the threshold.");
  field("by_class", prestress.by_class,
        "For each contact class, the number of its contacts and the number of their stiff tilts. The list is empty if "
        "a fit found no cut-off.");
}
inline void describe(Fields& field, Prestress& prestress) {
  describe_counts(field, prestress);
  const auto describe_normals = [&prestress](Fields& inner) {
    inner.type("stiff_rank", "Number, rank and missing rank of the constraints.");
    add_rank(inner, prestress.normals,
             {"missing_n", prestress_group, "m_n",
              "Missing rank per particle, (6N − 3 − rank)/N, if the only constraint of a contact is its "
              "normal."});
  };
  field.nested("normals", describe_normals,
               "Rank of the rigidity matrix in which the only constraint of a contact is its normal.");
  field("without_second", prestress.without_second,
        "Number of contacts for which the second term of the stiffness, ½ V ∇²V, could not be computed.");
  field("modes", prestress.modes,
        "Contributions of the normals, the stiff tilts and the prestress to the stiffness λ of the modes.");
  field("s_normal", prestress.s_normal,
        "Relative stiffness κR/f of the normal of every contact, ascending, where κ is the stiffness of the normal. "
        "Only the state nearest jamming and the states whose Δφ is closest to 0.005 and to 0.02 have this field.")
      .detail();
  field("s_tilt", prestress.s_tilt,
        "Relative stiffness s = κR/f of every tilt with s above 0.1, ascending. The states that have the field "
        "`s_normal` also have this field.")
      .detail();
}

struct PrestressOfState {
  Prestress prestress;
};
inline void describe(Fields& field, PrestressOfState& state) {
  field("prestress", state.prestress,
        "Results from the stiffness of every contact, ½ ggᵀ + ½ V ∇²V with g = ∇V. They are the number and rank of the "
        "constraints that this stiffness defines, and the contributions of normals, stiff tilts and prestress to the "
        "stiffness of the modes.");
}

}  // namespace isojam
