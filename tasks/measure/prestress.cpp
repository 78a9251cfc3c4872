#include <algorithm>
#include <cmath>

#include "engine/arithmetic/elementary.hpp"
#include "engine/rigidity/pair_stiffness.hpp"
#include "engine/rigidity/rigidity.hpp"
#include "engine/vibration/dynamical_matrix.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/measure/prestress_fields.hpp"
#include "tasks/measure/shared_parts.hpp"

namespace isojam {
namespace {

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
  StiffnessOfModes listed;
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
    support.listed.worst_sum = std::max(support.listed.worst_sum, std::abs(shares.total() - value) / value);
    if (shares.normal + shares.tilt < value / 2) support.sum_of_logs += nearest::log(value);
    if (support.resolved++ >= listed_modes) continue;
    support.listed.lambda.push_back(to_digits(value, 5));
    support.listed.normal.push_back(to_digits(shares.normal / value, 4));
    support.listed.tilt.push_back(to_digits(shares.tilt / value, 4));
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
  const int by_prestress = support.by_prestress[chosen];
  record.prestress_lambda =
      given(by_prestress > 0, nearest::exp(support.sum_of_logs / std::max(by_prestress, 1)), "no such modes");
  record.listed = std::move(support.listed);
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
    PrestressOfState state;
    add_counts(state.prestress, packing, stiffness);
    state.prestress.modes = held_modes(stiffness, modes_of(packing, energy, options.modes));
    if (std::find(kept.begin(), kept.end(), k) != kept.end()) add_bands(state.prestress, stiffness.pairs);
    measurement.states.push_back(written(state));
  }
  return measurement;
}

}  // namespace

const MeasureDefinition measures::prestress{
    .state = part_of<PrestressOfState>(), .measure = measure_prestress, .needs_minima = true};

}  // namespace isojam
