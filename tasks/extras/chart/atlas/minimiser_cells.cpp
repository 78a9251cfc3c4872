#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/solve/jam.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "engine/vibration/stability.hpp"
#include "tasks/extras/chart/atlas/atlas.hpp"
#include "tasks/extras/chart/atlas/cells.hpp"
#include "tasks/extras/chart/atlas/states.hpp"

namespace isojam {

namespace {

/// Largest number of evaluations, the same for all methods. Newton's method needs at most about 600 for Δφ ≥ 2e-3. More
/// evaluations would not help the other methods: for Δφ ≤ 0.02 their residual is of order 1.
constexpr long budget = 1000;

/// Largest number of evaluations for multipliers, which evaluate an envelope of the energy. No step needs so many.
constexpr long follow_budget = 3000;

constexpr double residual = 1e-6;

struct Minimiser {
  std::string name;
  bool standard;
  MinimiseOptions options;
};

Minimiser minimiser(const std::string& name, Method method, double energy_change = 0) {
  MinimiseOptions options;
  options.method = method;
  options.residual = residual;
  options.max_evaluations = budget;
  // At Δφ = 5e-4, E/N ~ Δφ⁶ is 2e-20. This is below the default energy at which a state counts as unjammed.
  options.unjammed_energy = 1e-26;
  options.energy_change = energy_change;
  // With the paper's stopping rule, the residual must not stop the minimisation first.
  if (energy_change > 0) options.residual = 1e-14;
  return {name, method == Method::newton, options};
}

std::array<Minimiser, 5> minimisers() {
  return {minimiser("Newton", Method::newton), minimiser("conjugate gradients", Method::conjugate_gradient),
          minimiser("conjugate gradients until energy changes by < 1e-12", Method::conjugate_gradient, 1e-12),
          minimiser("FIRE", Method::fire), minimiser("L-BFGS", Method::lbfgs)};
}

/// Largest net force, or net torque divided by R, in units of the mean contact force. Computed anew in double-double.
double residual_of(const Packing& packing) {
  return PackingEnergy().evaluate(packing, Precision::double_double).residual;
}

/// Verdicts: `holds` if the forces balance, `refuses` if the method reports that it did not finish, and `fails` if it
/// reports success although the forces do not balance.
AtlasRow judged_end(AtlasRow row, const MinimiseSummary& summary, const Packing& packing, StopReason wanted) {
  const double left = residual_of(packing);
  row.figure = fmt::format("residual {:.0e} after {} evaluations", left, summary.evaluations + summary.work.envelopes);
  row.reason = to_string(summary.reason);
  // The method may have measured its residual in doubles; the factor 1.1 allows for their rounding.
  const bool balanced = left <= 1.1 * residual;
  if (wanted == StopReason::unjammed ? summary.reason == wanted : balanced) {
    row.verdict = AtlasVerdict::holds;
  } else {
    const bool gave_up = summary.reason == StopReason::budget || summary.reason == StopReason::line_search_failed ||
                         summary.reason == StopReason::precision_floor;
    row.verdict = gave_up ? AtlasVerdict::refuses : AtlasVerdict::fails;
  }
  return row;
}

void append_starts(const std::string& regime, const std::string& setting, const Packing& start, StopReason wanted,
                   AtlasRows& rows) {
  for (const Minimiser& method : minimisers()) {
    if (rows.over()) return;
    Packing packing = start;
    PackingEnergy energy;
    const MinimiseSummary summary = minimise(packing, energy, method.options, rows.stop());
    rows.add(judged_end({regime, setting, method.name, method.standard, {}, {}, {}}, summary, packing, wanted));
  }
}

/// Follows the equilibrium `from` to a new density.
void append_followed(const std::string& regime, const std::string& setting, const Packing& from, double distance,
                     double density, AtlasRows& rows) {
  if (rows.over()) return;
  MinimiseOptions options = minimiser("", Method::multipliers).options;
  options.max_evaluations = follow_budget;
  Packing packing = from;
  PackingEnergy energy;
  const MinimiseSummary summary = follow_equilibrium(packing, density, distance, energy, options, rows.stop());
  rows.add(
      judged_end({regime, setting, "multipliers", true, {}, {}, {}}, summary, packing, StopReason::residual_reached));
}

void append_distances(const AtlasStates& states, AtlasRows& rows) {
  for (const double distance : {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005}) {
    const std::string regime = "strained to Δφ", setting = fmt::format("{:.0e}", distance);
    const Packing& from = states.above(distance);
    const double density = states.phi_j() + distance;
    append_followed(regime, setting, from, states.distance_of(from), density, rows);
    append_starts(regime, setting, strained_to(from, density), StopReason::residual_reached, rows);
  }
}

/// A jammed packing from which one particle was removed. The neighbours of the vacancy have few contacts.
Packing with_vacancy(const AtlasStates& states) {
  Packing packing = states.above(0.03);
  packing.poses.erase(packing.poses.begin());
  return packing;
}

/// Counts the zero modes of the packing with the vacancy. If there are more than three, near-rattlers must explain
/// them.
AtlasRow judged_rattlers(Packing packing, const std::stop_token& stop) {
  PackingEnergy energy;
  minimise(packing, energy, minimisers().front().options, stop);
  const BlockMatrix matrix = energy.hessian(packing, Precision::double_double);
  const Stability found = assess(matrix, spectrum_ends(matrix));
  AtlasRow row{"near-rattlers", "beside a vacancy", "modes by inertia", true, {}, {}, {}};
  row.figure = fmt::format("{} zero modes, {} negative modes, {} near-rattlers found", found.zero, found.negative,
                           found.near_rattlers.size());
  row.reason = to_string(found.verdict);
  const bool is_decided = found.verdict == Verdict::stable || !found.near_rattlers.empty();
  row.verdict = is_decided ? AtlasVerdict::holds : AtlasVerdict::fails;
  return row;
}

void append_other_starts(const AtlasStates& states, AtlasRows& rows) {
  append_starts("already jammed start", "residual 1e-9", states.above(0.02), StopReason::residual_reached, rows);
  append_starts("near-rattlers", "beside a vacancy", with_vacancy(states), StopReason::residual_reached, rows);
  rows.add(judged_rattlers(with_vacancy(states), rows.stop()));
  RandomStream random{3};
  const Packing loose = random_packing(platonic(SolidKind::octahedron), 45, 0.3, random);
  append_starts("unjammed start", "φ = 0.3", loose, StopReason::unjammed, rows);
}

/// Translates equilibria through the boundary of the cell. The translation is not exact in doubles, and the low parts
/// of the coordinates contribute to the balance of forces.
void append_translated(const AtlasStates& states, AtlasRows& rows) {
  for (const double distance : {0.1, 0.005}) {
    Packing packing = states.above(distance);
    const Eigen::Vector3d shift = packing.cell.side() * Eigen::Vector3d(0.37, -1.61, 0.73);
    for (Pose& pose : packing.poses) pose = moved(pose, shift, Eigen::Vector3d::Zero());
    for (const Precision precision : {Precision::double_double, Precision::working}) {
      const bool in_double_double = precision == Precision::double_double;
      const double left = PackingEnergy().evaluate(packing, precision).residual;
      rows.add(judged({"equilibrium translated through the boundary",
                       fmt::format("Δφ = {:.0e}", distance),
                       in_double_double ? "state in double-double" : "state in doubles",
                       in_double_double,
                       {},
                       {},
                       {}},
                      left, 1e-8, "residual"));
    }
  }
}

AtlasRow judged_jam(AtlasRow row, const JamResult& result) {
  row.reason = to_string(result.status);
  if (!result.phi_j) {
    row.figure = fmt::format("{} strain steps", result.path.size());
    row.verdict = AtlasVerdict::refuses;
    return row;
  }
  double worst = 0;
  for (const Packing& state : result.states) worst = std::max(worst, residual_of(state));
  row.figure = fmt::format("φ_J = {:.3f}, worst residual {:.0e}", result.phi_j->density, worst);
  row.verdict = worst <= 1.1 * residual ? AtlasVerdict::holds : AtlasVerdict::fails;
  return row;
}

void append_protocols(AtlasRows& rows) {
  const auto run = [&](const std::string& regime, SolidKind kind, double initial_density,
                       double target_energy = JamOptions().compression.target_energy) {
    if (rows.over()) return;
    JamOptions options;
    options.compression.initial_density = initial_density;
    options.compression.target_energy = target_energy;
    options.decompression.final_distance = 0.02;
    const ConvexSolid& solid = platonic(kind);
    RandomStream random{5, static_cast<std::uint64_t>(kind)};
    const Packing start =
        random_packing(solid, least_particles(solid, options.compression.max_density), initial_density, random);
    rows.add(judged_jam({regime,
                         fmt::format("{} from φ = {}, E/N = {:.1e}", to_string(kind), initial_density, target_energy),
                         "protocol",
                         true,
                         {},
                         {},
                         {}},
                        jam(start, options, rows.stop())));
  };
  run("cubes", SolidKind::cube, 0.2);
  run("cubes", SolidKind::cube, 0.2, 1e-8);
  run("already jammed start", SolidKind::octahedron, 0.8);
  run("unjammed start", SolidKind::octahedron, 0.2);
}

}  // namespace

std::vector<AtlasRow> minimiser_atlas(const AtlasStates& states, const std::stop_token& stop) {
  AtlasRows rows(stop);
  append_distances(states, rows);
  append_other_starts(states, rows);
  append_translated(states, rows);
  append_protocols(rows);
  return rows.taken();
}

}  // namespace isojam
