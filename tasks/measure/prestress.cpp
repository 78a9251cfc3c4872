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
constexpr Quantity C_s{"C_s", "/prestress/C_s", group, per_particle, "C_s"};
constexpr Quantity missing_s{"missing_s", "/prestress/missing", group, per_particle, "m_s"};
constexpr Quantity missing_n{"missing_n", "/prestress/normals/missing", group, per_particle, "m_n"};
constexpr Quantity self_stress_s{"self_stress_s", "/prestress/self_stress", group, "1", "s_s"};
constexpr Quantity held_by_second{"held_by_second", "/prestress/modes/held_by_second", group, "1", "n_2"};
constexpr Quantity held_by_prestress{"held_by_prestress", "/prestress/modes/held_by_prestress", group, "1", "n_p"};
constexpr std::array quantities{C_s, missing_s, missing_n, self_stress_s, held_by_second, held_by_prestress};

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

void put_rank(Json& json, const Rigidity& rigidity, int particles) {
  put_number(json, "missing", missing(rigidity, particles));
  json["constraints"] = rigidity.constraints;
  json["rank"] = rigidity.rank;
  put_number(json, "tolerance", rigidity.tolerance);
  put_number(json, "least_kept", rigidity.least_kept);
  put_number(json, "largest_dropped", rigidity.largest_dropped);
}

struct StateStiffness : ClassifiedContacts {
  std::vector<PairStiffness> pairs;
};

/// Numbers of contacts and of stiff tilts in each contact class. Empty if the contacts are not classified.
Json tilts_by_class(const StateStiffness& stiffness) {
  Json list = Json::array();
  if (undecided(stiffness.analysis)) return list;
  for (const auto& [value, name] : enum_names<ContactClass>) {
    int contacts = 0, tilts = 0;
    for (std::size_t c = 0; c < stiffness.pairs.size(); ++c) {
      if (stiffness.analysis.classes[c] != value) continue;
      ++contacts;
      tilts += stiffness.pairs[c].stiff_tilts(threshold);
    }
    list.push_back({{"class", name}, {"contacts", contacts}, {"stiff_tilts", tilts}});
  }
  return list;
}

void put_counts(Json& state, const Packing& packing, const StateStiffness& stiffness) {
  const int n = packing.size();
  Json list = Json::array();
  for (const double s : thresholds) {
    Json json;
    json["threshold"] = s;
    put_number(json, "C", stiff_constraint_number(n, stiffness.pairs, s));
    if (s == threshold) {
      const auto rigidity = analyse_rigidity(stiff_constraints(packing, stiffness.contacts, stiffness.pairs, s));
      put_rank(json, rigidity, n);
      json["self_stress"] = rigidity.self_stress;
      put(state, C_s, stiff_constraint_number(n, stiffness.pairs, s));
      put(state, missing_s, missing(rigidity, n));
      put(state, self_stress_s, rigidity.self_stress);
    }
    list.push_back(std::move(json));
  }
  state["prestress"]["thresholds"] = std::move(list);
  state["prestress"]["by_class"] = tilts_by_class(stiffness);
  const auto normals = analyse_rigidity(normal_constraints(packing, stiffness.contacts));
  put_rank(state["prestress"]["normals"], normals, n);
  put(state, missing_n, missing(normals, n));
  state["prestress"]["without_second"] =
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
  Json lambda = Json::array(), normal = Json::array(), tilt = Json::array();
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

constexpr std::string_view more = "all modes that were looked at are, and others may be";

/// The number of modes with a property, of which `count` were found. nullopt if all examined modes above the tolerance
/// have the property, but some modes were not examined: these may have it too.
std::optional<double> known(const Modes& modes, const PrestressSupport& support, int count) {
  return modes.all || count < support.resolved ? std::optional<double>(count) : std::nullopt;
}

/// Adds the numbers of modes for all shares and thresholds.
void put_choices(Json& json, const Modes& modes, const PrestressSupport& support) {
  Json shares = Json::array(), stiff = Json::array();
  for (std::size_t t = 0; t < normal_shares.size(); ++t) {
    Json entry{{"normals_below", normal_shares[t]}};
    put_optional(entry, "modes", known(modes, support, support.by_second[t]), more);
    shares.push_back(std::move(entry));
  }
  for (std::size_t t = 0; t < thresholds.size(); ++t) {
    Json entry{{"threshold", thresholds[t]}};
    put_optional(entry, "modes", known(modes, support, support.by_prestress[t]), more);
    stiff.push_back(std::move(entry));
  }
  json["second_by_share"] = std::move(shares);
  json["prestress_by_threshold"] = std::move(stiff);
}

void put_modes(Json& state, const StateStiffness& stiffness, const Modes& modes) {
  PrestressSupport support = support_by(stiffness, modes);
  put(state, held_by_second, known(modes, support, support.by_second.front()), more);
  put(state, held_by_prestress, known(modes, support, support.by_prestress[chosen]), more);
  Json& json = state["prestress"]["modes"];
  put_choices(json, modes, support);
  json["looked_at"] = modes.set.size();
  json["unresolved"] = modes.set.size() - support.resolved;
  put_number(json, "worst_sum", support.worst_sum);
  const int by_prestress = support.by_prestress[chosen];
  put_optional(json, "prestress_lambda",
               by_prestress > 0 ? std::optional(nearest::exp(support.sum_of_logs / by_prestress)) : std::nullopt,
               "no such modes");
  json["lambda"] = std::move(support.lambda);
  json["normal"] = std::move(support.normal);
  json["tilt"] = std::move(support.tilt);
}

/// Adds the relative stiffnesses s of all normals and tilts in ascending order, for plots of their distributions.
void put_bands(Json& json, const std::vector<PairStiffness>& pairs) {
  constexpr double least = 0.1;
  std::vector<double> normals, tilts;
  for (const PairStiffness& pair : pairs) {
    normals.push_back(to_digits(pair.relative_normal(), 4));
    for (int k = 0; k < 5 && pair.relative_tilt(k) > least; ++k) tilts.push_back(to_digits(pair.relative_tilt(k), 4));
  }
  std::sort(normals.begin(), normals.end());
  std::sort(tilts.begin(), tilts.end());
  json["s_normal"] = normals;
  json["s_tilt"] = tilts;
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
    Json state;
    put_counts(state, packing, stiffness);
    put_modes(state, stiffness, modes_of(packing, energy, options.modes));
    if (std::find(kept.begin(), kept.end(), k) != kept.end()) put_bands(state["prestress"], stiffness.pairs);
    measurement.states.push_back(std::move(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::prestress{
    .quantities = quantities, .measure = measure_prestress, .needs_minima = true};

}  // namespace isojam
