#include <algorithm>
#include <cmath>

#include "engine/arithmetic/elementary.hpp"
#include "engine/rigidity/pair_stiffness.hpp"
#include "engine/rigidity/rigidity.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

constexpr QuantityGroup group{"prestress",
                              "Constraints from stiff contacts, and vibrations with and without contact forces."};
constexpr std::string_view per_particle = "per particle";

/// A rank, or one that is optional.
template <class Number, class Count>
struct StiffRank {
  Number missing{};
  Count constraints{}, rank{};
  Number tolerance{}, least_kept{}, largest_dropped{};
};
template <class Rank>
void add_rank(Fields& field, Rank& rank, const Column& missing) {
  field("missing", rank.missing, "Missing rank per particle, (6N − 3 − rank)/N.")
      .unit(per_particle)
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
void describe(Fields& field, StiffCount& count) {
  field.type("stiff_count",
             "Number of constraints for one threshold of s. With a threshold other than 10, only the fields "
             "`threshold` and `C` are present.");
  field("threshold", count.threshold, "Threshold of s: a tilt with a larger s counts as a constraint.")
      .range({0, any_number.high, true})
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
void describe(Fields& field, TiltsOfClass& tilts) {
  field("class", tilts.which, "Contact class, according to the fitted cut-offs.");
  field("contacts", tilts.contacts, "Number of contacts of this class.");
  field("stiff_tilts", tilts.stiff_tilts, "Number of stiff tilts of all contacts of this class.");
}

struct SecondByShare {
  double normals_below = 0;
  Reasoned<> modes;
};
void describe(Fields& field, SecondByShare& second) {
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
void describe(Fields& field, PrestressByThreshold& prestress) {
  field("threshold", prestress.threshold, "Threshold of s.").range({0, any_number.high, true}).finite();
  field("modes", prestress.modes,
        "Number of modes in which the normals and the tilts with s above this threshold together contribute less than "
        "half of λ; null in the same case as `held_by_prestress`.")
      .range(not_negative);
}

struct HeldModes {
  Reasoned<> held_by_second, held_by_prestress;
  std::vector<SecondByShare> second_by_share;
  std::vector<PrestressByThreshold> prestress_by_threshold;
  Eigen::Index looked_at = 0, unresolved = 0;
  double worst_sum = 0;
  Reasoned<> prestress_lambda;
  std::vector<double> lambda, normal, tilt;
};
void describe_lists(Fields& field, HeldModes& modes) {
  field("lambda", modes.lambda, "Stiffness λ of the lowest analysed modes, at most 50, ascending.").detail();
  field("normal", modes.normal, "Share of the normals in the stiffness, for each mode of the list `lambda`.").detail();
  field("tilt", modes.tilt,
        "Share of the stiff tilts in the stiffness, for each mode of the list `lambda`. The rest is the share of the "
        "prestress.")
      .detail();
}
void describe(Fields& field, HeldModes& modes) {
  field.type("held_modes",
             "Contributions of the normals, the stiff tilts and the prestress to the stiffness λ of the modes. If N is "
             "at most 150, all modes are analysed. Otherwise, only the lowest modes are analysed; their number is "
             "`spec.modes`.");
  field("held_by_second", modes.held_by_second,
        "Number of modes in which the normals contribute less than half of the stiffness λ. If N is above 150, only "
        "the lowest modes are analysed; the value is null if all of these satisfy the condition, because other modes "
        "may satisfy it too.")
      .range(not_negative)
      .column({.name = "held_by_second", .group = group, .latex = "n_2", .place = 2});
  field("held_by_prestress", modes.held_by_prestress,
        "Number of modes in which the normals and the stiff tilts together contribute less than half of the stiffness "
        "λ. If N is above 150, only the lowest modes are analysed; the value is null if all of these satisfy the "
        "condition, because other modes may satisfy it too.")
      .range(not_negative)
      .column({.name = "held_by_prestress", .group = group, .latex = "n_p", .place = 2});
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
  field("worst_sum", modes.worst_sum,
        "Largest relative difference between λ of a mode and the sum of its three contributions.");
  field("prestress_lambda", modes.prestress_lambda,
        "Geometric mean of λ over the modes that are counted in `held_by_prestress`; null if there is none.");
  describe_lists(field, modes);
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
void describe_counts(Fields& field, Prestress& prestress) {
  field("C_s", prestress.C_s,
        "Constraint number C_s: number of constraints per particle, if the constraints of a contact are its normal and "
        "its stiff tilts; each contact counts for both of its particles. If C_s = 12, there are as many constraints as "
        "degrees of freedom.")
      .unit(per_particle)
      .column({"C_s", group, "C_s"});
  field("missing", prestress.missing,
        "Missing rank per particle, (6N − 3 − rank)/N, if the constraints of a contact are its normal and its stiff "
        "tilts.")
      .unit(per_particle)
      .column({"missing_s", group, "m_s"});
  field("self_stress", prestress.self_stress,
        "Number of states of self-stress if the constraints of a contact are its normal and its stiff tilts.")
      .column({.name = "self_stress_s", .group = group, .latex = "s_s", .place = 1});
  field("thresholds", prestress.thresholds,
        "Numbers of constraints for several thresholds. A tilt counts as a constraint if its relative stiffness s = "
        "κR/f is above the threshold.");
  field("by_class", prestress.by_class,
        "For each contact class, the number of its contacts and the number of their stiff tilts. The list is empty if "
        "a fit found no cut-off.");
}
void describe(Fields& field, Prestress& prestress) {
  describe_counts(field, prestress);
  const auto describe_normals = [&prestress](Fields& inner) {
    inner.type("stiff_rank", "Number, rank and missing rank of the constraints.");
    add_rank(inner, prestress.normals,
             {.name = "missing_n",
              .group = group,
              .latex = "m_n",
              .meaning = "Missing rank per particle, (6N − 3 − rank)/N, if the only constraint of a contact is its "
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

struct State {
  Prestress prestress;
};
void describe(Fields& field, State& state) {
  field("prestress", state.prestress,
        "Results from the stiffness of every contact, ½ ggᵀ + ½ V ∇²V with g = ∇V. They are the number and rank of the "
        "constraints that this stiffness defines, and the contributions of normals, stiff tilts and prestress to the "
        "stiffness of the modes.");
}

/// A tilt counts as a constraint if its relative stiffness s is above this threshold. The numbers for other thresholds
/// show how much the result depends on this choice.
constexpr double threshold = 10;
constexpr std::array thresholds{1.0, 3.0, 10.0, 30.0, 100.0};
/// For each of these shares, the modes are counted in which the normals have a smaller share of the stiffness.
constexpr std::array normal_shares{.5, .1, .01};
/// Up to this N all modes are used. For larger packings only the softest modes are used, as many as the manifest
/// requests.
constexpr int all_modes_up_to = 150;
/// The stiffness of every contact is stored for the nearest state and for the states closest to these Δφ.
constexpr std::array kept_near{.02, .005};

/// (6N − 3 − rank)/N.
double missing(const Rigidity& rigidity, int particles) {
  return static_cast<double>(6L * particles - 3 - rigidity.rank) / particles;
}

template <class Rank>
void put_rank(Rank& rank, const Rigidity& found, int particles) {
  rank = {missing(found, particles), found.constraints, found.rank,
          found.tolerance,           found.least_kept,  found.largest_dropped};
}

struct StateStiffness : ClassifiedContacts {
  std::vector<PairStiffness> pairs;
};

/// Numbers of contacts and of stiff tilts in each contact class. Empty if the contacts are not classified.
std::vector<TiltsOfClass> tilts_by_class(const StateStiffness& stiffness) {
  std::vector<TiltsOfClass> list;
  if (undecided(stiffness.analysis)) return list;
  for (const auto which : all_of<ContactClass>) {
    auto& tilts = list.emplace_back(TiltsOfClass{which});
    for (std::size_t c = 0; c < stiffness.pairs.size(); ++c) {
      if (stiffness.analysis.classes[c] != which) continue;
      ++tilts.contacts;
      tilts.stiff_tilts += stiffness.pairs[c].stiff_tilts(threshold);
    }
  }
  return list;
}

void add_counts(Prestress& record, const Packing& packing, const StateStiffness& stiffness) {
  const int n = packing.size();
  for (const double s : thresholds) {
    auto& count = record.thresholds.emplace_back(StiffCount{s, stiff_constraint_number(n, stiffness.pairs, s), {}, {}});
    if (s != threshold) continue;
    const auto rigidity = analyse_rigidity(stiff_constraints(packing, stiffness.contacts, stiffness.pairs, s));
    put_rank(count.rank, rigidity, n);
    count.self_stress = record.self_stress = rigidity.self_stress;
    record.C_s = count.C;
    record.missing = missing(rigidity, n);
  }
  record.by_class = tilts_by_class(stiffness);
  put_rank(record.normals, analyse_rigidity(normal_constraints(packing, stiffness.contacts)), n);
  record.without_second =
      std::count_if(stiffness.pairs.begin(), stiffness.pairs.end(), [](const auto& pair) { return !pair.has_second; });
}

/// The examined modes of a state, softest first. Modes with an eigenvalue up to `tolerance` count as zero modes. `all`
/// is true if no mode was left out.
struct Modes {
  ModeSet set;
  double tolerance = 0;
  bool all = false;
};

Modes modes_of(const Packing& packing, PackingEnergy& energy, int wanted) {
  const auto here = energy.evaluate(packing, state_precision);
  const auto matrix = dynamical_matrix(packing, energy.hessian(packing, state_precision));
  const auto ends = spectrum_ends(matrix, {.lowest = wanted, .highest = 1});
  Modes modes;
  modes.tolerance =
      zero_tolerance(matrix, ends.lambda_max, unbalanced_torque(here, packing.solids) * greatest_inverse_mass(packing));
  modes.all = packing.size() <= all_modes_up_to;
  modes.set = modes.all ? dense_modes(matrix) : ends.lowest;
  modes.set.vectors = mode_displacements(packing, std::move(modes.set.vectors));
  return modes;
}

/// Numbers of modes by the origin of their stiffness. Only modes with an eigenvalue above the tolerance count.
struct PrestressSupport {
  int resolved = 0;
  std::array<int, normal_shares.size()> by_second{};  ///< modes with a small share of normals, by normal_shares
  std::array<int, thresholds.size()> by_prestress{};  ///< modes that prestress stiffens most, by thresholds
  double sum_of_logs = 0;                             ///< sum of ln λ over the modes that prestress stiffens most
  double worst_sum = 0;  ///< largest relative deviation of the sum of contributions from λ
  std::vector<double> lambda, normal, tilt;
};
constexpr int listed_modes = 50;

constexpr auto chosen = std::find(thresholds.begin(), thresholds.end(), threshold) - thresholds.begin();

PrestressSupport support_by(const StateStiffness& stiffness, const Modes& modes) {
  PrestressSupport support;
  for (Eigen::Index k = 0; k < modes.set.size(); ++k) {
    const double value = modes.set.eigenvalues[k];
    if (value <= modes.tolerance) continue;
    StiffnessShares shares;
    for (std::size_t t = 0; t < thresholds.size(); ++t) {
      const auto here = stiffness_shares(stiffness.contacts, stiffness.pairs, thresholds[t], modes.set.vectors.col(k));
      support.by_prestress[t] += here.normal + here.tilt < value / 2;
      if (t == chosen) shares = here;
    }
    for (std::size_t t = 0; t < normal_shares.size(); ++t)
      support.by_second[t] += shares.normal < normal_shares[t] * value;
    support.worst_sum = std::max(support.worst_sum, std::abs(shares.total() - value) / value);
    if (shares.normal + shares.tilt < value / 2) support.sum_of_logs += nearest::log(value);
    if (support.resolved++ >= listed_modes) continue;
    support.lambda.push_back(to_digits(value, 5));
    support.normal.push_back(to_digits(shares.normal / value, 4));
    support.tilt.push_back(to_digits(shares.tilt / value, 4));
  }
  return support;
}

/// The number of modes with a property, of which `count` were found. It is unknown if all examined modes above the
/// tolerance have the property, but some modes were not examined: these may have it too.
Reasoned<> known(const Modes& modes, const PrestressSupport& support, int count) {
  return given<double>(modes.all || count < support.resolved, count,
                       "all modes that were looked at are, and others may be");
}

HeldModes held_modes(const StateStiffness& stiffness, const Modes& modes) {
  PrestressSupport support = support_by(stiffness, modes);
  HeldModes record;
  record.held_by_second = known(modes, support, support.by_second.front());
  record.held_by_prestress = known(modes, support, support.by_prestress[chosen]);
  for (std::size_t t = 0; t < normal_shares.size(); ++t)
    record.second_by_share.push_back({normal_shares[t], known(modes, support, support.by_second[t])});
  for (std::size_t t = 0; t < thresholds.size(); ++t)
    record.prestress_by_threshold.push_back({thresholds[t], known(modes, support, support.by_prestress[t])});
  record.looked_at = modes.set.size();
  record.unresolved = modes.set.size() - support.resolved;
  record.worst_sum = support.worst_sum;
  const int by_prestress = support.by_prestress[chosen];
  record.prestress_lambda =
      given(by_prestress > 0, nearest::exp(support.sum_of_logs / std::max(by_prestress, 1)), "no such modes");
  record.lambda = std::move(support.lambda);
  record.normal = std::move(support.normal);
  record.tilt = std::move(support.tilt);
  return record;
}

/// Adds the relative stiffnesses s of all normals and tilts in ascending order, for plots of their distributions.
void add_bands(Prestress& record, const std::vector<PairStiffness>& pairs) {
  constexpr double least = 0.1;
  auto &normals = record.s_normal.emplace(), &tilts = record.s_tilt.emplace();
  for (const PairStiffness& pair : pairs) {
    normals.push_back(to_digits(pair.relative_normal(), 4));
    for (int k = 0; k < 5 && pair.relative_tilt(k) > least; ++k) tilts.push_back(to_digits(pair.relative_tilt(k), 4));
  }
  std::sort(normals.begin(), normals.end());
  std::sort(tilts.begin(), tilts.end());
}

/// Indices of the states for which the stiffness of every contact is stored.
std::vector<std::size_t> kept_states(const JamResult& jam) {
  std::vector<std::size_t> kept;
  if (const auto nearest = nearest_state(jam)) kept.push_back(*nearest);
  for (const double distance : kept_near) {
    if (!jam.phi_j || jam.states.empty()) break;
    const auto off = [&](const Packing& p) {
      return std::abs(nearest::log(std::max(p.density() - jam.phi_j->density, 1e-9) / distance));
    };
    const auto best = std::min_element(jam.states.begin(), jam.states.end(),
                                       [&](const Packing& a, const Packing& b) { return off(a) < off(b); });
    kept.push_back(static_cast<std::size_t>(best - jam.states.begin()));
  }
  return kept;
}

Measurement measure_prestress(const JamResult& jam, const MeasureOptions& options) {
  Measurement measurement;
  PackingEnergy energy;
  const auto kept = kept_states(jam);
  for (std::size_t k = 0; k < jam.states.size(); ++k) {
    const Packing& packing = jam.states[k];
    StateStiffness stiffness{classified_contacts(packing, energy), {}};
    stiffness.pairs = pair_stiffnesses(packing, stiffness.contacts);
    State state;
    add_counts(state.prestress, packing, stiffness);
    state.prestress.modes = held_modes(stiffness, modes_of(packing, energy, options.modes));
    if (std::find(kept.begin(), kept.end(), k) != kept.end()) add_bands(state.prestress, stiffness.pairs);
    measurement.states.push_back(written(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::prestress{
    .state = part_of<State>(), .measure = measure_prestress, .needs_minima = true};

}  // namespace isojam
