#include <fmt/format.h>

#include <cmath>
#include <map>
#include <utility>

#include "engine/analysis/contacts.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "tasks/extras/chart/comparisons.hpp"

namespace isojam {
namespace {

/// A minimiser with its settings. The chart shows both names.
struct Variant {
  std::string method, setting;
  MinimiseOptions options;
};

/// Variants of one method, in order of decreasing residual.
using Ladder = std::vector<Variant>;

std::vector<Ladder> ladders(const ChartConfig& config) {
  std::vector<double> tolerances = config.tolerances, changes = config.energy_changes;
  std::sort(tolerances.rbegin(), tolerances.rend());
  std::sort(changes.rbegin(), changes.rend());
  std::vector<Ladder> all;
  for (const Method method :
       {Method::multipliers, Method::newton, Method::lbfgs, Method::fire, Method::conjugate_gradient}) {
    Ladder& ladder = all.emplace_back();
    for (const double tolerance : tolerances) {
      MinimiseOptions options{.method = method, .residual = tolerance, .max_evaluations = config.max_evaluations};
      ladder.push_back({std::string(to_string(method)), fmt::format("residual {:g}", tolerance), options});
    }
  }
  // The paper's stopping rule considers only the energy.
  Ladder& paper = all.emplace_back();
  for (const double change : changes) {
    MinimiseOptions options{.method = Method::conjugate_gradient,
                            .residual = 0,
                            .energy_change = change,
                            .max_evaluations = config.rule_evaluations};
    paper.push_back({"conjugate_gradient by energy", fmt::format("energy change {:g}", change), options});
  }
  return all;
}

/// Final state of a variant.
struct EndState {
  std::vector<double> seconds;
  MinimiseSummary summary;
  EnergyPoint energy;
  ContactNumbers numbers;
  bool classes_known = false;  ///< true if both fits gave a cut-off; otherwise only Z is meaningful

  bool reached() const { return is_equilibrium(summary) || summary.reason == StopReason::energy_change; }
};

/// Text of the reason. A signal or the time limit `point_seconds` can interrupt a minimisation. The text names only the
/// time limit, because no state is kept after a signal.
std::string stopped_text(StopReason reason) {
  return std::string(reason == StopReason::interrupted ? "interrupted by the time limit" : to_string(reason));
}

void describe(const Packing& packing, EndState& state) {
  PackingEnergy energy;
  const Evaluation value = energy.evaluate(packing, Precision::double_double);
  const double density = packing.density();
  state.energy = {density, value.energy / packing.size(), value.pressure / (density * density)};
  const auto angles = alignments(packing.solids, energy.contacts(packing));
  const ContactAnalysis analysis = analyse_contacts(packing.solids.only(), packing.size(), angles);
  const auto decided = [](const CdfFit& fit) { return fit.has_cutoff(); };
  state.numbers = analysis.numbers;
  state.classes_known = decided(analysis.face_face) && decided(analysis.edge_face);
}

EndState minimised(const StrainStart& start, const MinimiseOptions& options, const Measuring& measuring) {
  EndState state;
  Packing packing = start.equilibrium;
  state.seconds = timed(measuring, [&] {
    const Deadline deadline(measuring.config.point_seconds, measuring.stop);
    PackingEnergy energy;
    if (options.method == Method::multipliers) {
      packing = start.equilibrium;
      state.summary = follow_equilibrium(packing, start.density, start.distance, energy, options, deadline.token());
    } else {
      packing = start.strained();
      state.summary = minimise(packing, energy, options, deadline.token());
    }
  });
  describe(packing, state);
  return state;
}

/// States that a variant found, by [number of the packing][Δφ].
using EndStates = std::map<std::pair<int, double>, EndState>;

/// Median of the values, or null if there are none.
Json median_or_null(const std::vector<double>& values) {
  const auto of = spread(values);
  return of ? Json(of->median) : Json(nullptr);
}

ChartPoint point_of(const Variant& variant, SolidKind solid, double distance, const EndStates& states,
                    const EndStates& reference) {
  ChartPoint point{task_name(solid, distance), variant.method, variant.setting, {}, {}, {}, false, Json::object()};
  std::vector<double> seconds, residuals, evaluations, z, z_bias, c, c_bias;
  std::map<std::string, int> reasons;
  for (const auto& [key, state] : states) {
    if (key.second != distance) continue;
    seconds.insert(seconds.end(), state.seconds.begin(), state.seconds.end());
    residuals.push_back(state.summary.residual);
    evaluations.push_back(static_cast<double>(state.summary.evaluations + state.summary.work.envelopes));
    ++reasons[stopped_text(state.summary.reason)];
    point.failed |= !state.reached();
    z.push_back(state.numbers.Z);
    if (state.classes_known) c.push_back(state.numbers.C);
    const auto right = reference.find(key);
    if (right == reference.end()) continue;
    z_bias.push_back(state.numbers.Z - right->second.numbers.Z);
    if (state.classes_known && right->second.classes_known) c_bias.push_back(state.numbers.C - right->second.numbers.C);
  }
  point.seconds = spread(seconds);
  point.error = spread(residuals);
  point.stopped = reasons_text(reasons);
  point.further = {{"evaluations", median_or_null(evaluations)},
                   {"Z", median_or_null(z)},
                   {"Z_bias", median_or_null(z_bias)},
                   {"C", median_or_null(c)},
                   {"C_bias", median_or_null(c_bias)}};
  return point;
}

std::optional<JammingPoint> fitted(const EndStates& states, int packing, double window) {
  std::vector<EnergyPoint> energies;
  for (const auto& [key, state] : states) {
    if (key.first == packing) energies.push_back(state.energy);
  }
  return fit_jamming_point(energies, window);
}

/// Error of the φ_J that is fitted to the states of a variant.
ChartPoint bias_of(const Variant& variant, SolidKind solid, const EndStates& states, const EndStates& reference,
                   const ChartConfig& config) {
  ChartPoint point{std::string(to_string(solid)), variant.method, variant.setting, {}, {}, {}, false, Json::object()};
  std::map<int, double> seconds;
  std::map<std::string, int> reasons;
  for (const auto& [key, state] : states) {
    seconds[key.first] += spread(state.seconds)->median;
    ++reasons[stopped_text(state.summary.reason)];
    point.failed |= !state.reached();
  }
  std::vector<double> totals, errors, differences, values;
  for (const auto& [packing, total] : seconds) {
    totals.push_back(total);
    const auto found = fitted(states, packing, config.fit_window),
               right = fitted(reference, packing, config.fit_window);
    if (!found || !right) continue;
    values.push_back(found->density);
    differences.push_back(found->density - right->density);
    errors.push_back(std::abs(differences.back()));
  }
  point.seconds = spread(totals);
  point.error = spread(errors);
  point.failed |= errors.empty();
  point.stopped = reasons_text(reasons);
  point.further = {{"phi_j", median_or_null(values)}, {"phi_j_bias", median_or_null(differences)}};
  return point;
}

class Minimisers {
 public:
  Minimisers(std::span<const JammedSolid> jammed, const Measuring& measuring, ChartFamily& equilibrium,
             ChartFamily& bias)
      : jammed_(jammed), measuring_(measuring), config_(measuring.config), equilibrium_(equilibrium), bias_(bias) {}

  void run() {
    for (const SolidKind solid : config_.solids) {
      // From a strained packing, a minimiser may reach another solution branch than a method that follows the
      // equilibrium. Neither is an error, so each kind of method has its own reference.
      const EndStates followed = reference(solid, Method::multipliers), minimised = reference(solid, Method::newton);
      for (const Ladder& ladder : ladders(config_))
        climb(solid, ladder, ladder.front().options.method == Method::multipliers ? followed : minimised);
    }
  }

 private:
  /// Minimises every initial state of a solid. After a stop request, returns the states found so far.
  EndStates all_states(SolidKind solid, const Variant& variant, const std::vector<double>& missed = {}) {
    EndStates states;
    for (const JammedSolid& jammed : jammed_) {
      for (const double distance : config_.distances) {
        if (jammed.solid != solid || measuring_.over()) continue;
        if (std::find(missed.begin(), missed.end(), distance) != missed.end()) continue;
        const auto start = start_at(jammed, distance);
        if (!start) continue;
        measuring_.progress(fmt::format("{}, {}, {}", task_name(solid, distance), variant.method, variant.setting));
        EndState state = minimised(*start, variant.options, measuring_);
        if (!measuring_.over()) states.emplace(std::pair(jammed.number, distance), std::move(state));
      }
    }
    return states;
  }

  EndStates reference(SolidKind solid, Method method) {
    return all_states(solid, {std::string(to_string(method)), "reference", {.method = method, .residual = 1e-9}});
  }

  void climb(SolidKind solid, const Ladder& ladder, const EndStates& reference) {
    std::vector<double> missed;
    EndStates carried;
    for (const Variant& variant : ladder) {
      EndStates states = all_states(solid, variant, missed);
      if (measuring_.over()) return;
      for (const double distance : config_.distances) {
        const ChartPoint point = point_of(variant, solid, distance, states, reference);
        if (!point.seconds) continue;
        if (point.failed) missed.push_back(distance);
        equilibrium_.points.push_back(point);
      }
      if (states.empty()) return;
      // A method that missed a residual is not run for smaller ones. For these, its last state counts.
      for (const auto& [key, state] : carried) states.try_emplace(key, state);
      bias_.points.push_back(bias_of(variant, solid, states, reference, config_));
      carried = std::move(states);
    }
  }

  std::span<const JammedSolid> jammed_;
  const Measuring& measuring_;
  const ChartConfig& config_;
  ChartFamily &equilibrium_, &bias_;
};

}  // namespace

void compare_minimisers(std::span<const JammedSolid> jammed, const Measuring& measuring, ChartFamily& equilibrium,
                        ChartFamily& bias) {
  Minimisers(jammed, measuring, equilibrium, bias).run();
}

}  // namespace isojam
