#include <fmt/format.h>

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "engine/analysis/power_law.hpp"
#include "engine/random/stream.hpp"
#include "engine/solve/multipliers/multipliers.hpp"
#include "tasks/extras/chart/comparisons.hpp"

namespace isojam {
namespace {

/// CPU times of one method for one solid.
struct Timed {
  std::vector<double> particles, seconds;
  std::map<int, std::vector<double>> by_size;
  std::map<int, std::map<std::string, int>> reasons;
  std::map<int, bool> failed;

  void add(int size, double taken, const std::map<std::string, int>& why, bool fine) {
    by_size[size].push_back(taken);
    for (const auto& [reason, count] : why) reasons[size][reason] += count;
    failed[size] |= !fine;
    // A run that ended too early does not show the full cost, so it does not contribute to the fit.
    if (!fine) return;
    particles.push_back(size);
    seconds.push_back(taken);
  }
};

constexpr std::array methods{"replicate", "equilibrium", "evaluation"};
/// Number of evaluations that are timed together, because a single one is too short for the clock.
constexpr int evaluations_timed = 20;

class Growth {
 public:
  Growth(const Measuring& measuring, ChartFamily& family)
      : measuring_(measuring), config_(measuring.config.growth), family_(family) {}

  void run() {
    for (const SolidKind solid : config_.solids) {
      timed_.clear();
      for (const int particles : config_.particles) {
        for (int k = 0; k < config_.replicates && !measuring_.over(); ++k) measure(solid, particles, k);
      }
      report(std::string(to_string(solid)));
    }
  }

 private:
  void measure(SolidKind solid, int particles, int number) {
    measuring_.progress(fmt::format("growth, {}, N = {}, replicate {}", to_string(solid), particles, number + 1));
    const JamOptions options;
    RandomStream random{measuring_.config.seed, static_cast<std::uint64_t>(solid),
                        static_cast<std::uint64_t>(particles), static_cast<std::uint64_t>(number)};
    const double before = thread_cpu_seconds();
    Packing placed = random_packing(platonic(solid), particles, options.compression.initial_density, random);
    JamResult result = jam(std::move(placed), options, measuring_.stop);
    const double taken = thread_cpu_seconds() - before;
    if (measuring_.over()) return;
    timed_["replicate"].add(particles, taken, {{std::string(to_string(result.status)), 1}}, result.phi_j.has_value());
    if (!result.phi_j) return;
    const JammedSolid jammed{solid, number, result.phi_j->density, std::move(result.states)};
    measure_equilibria(jammed, options.minimise, particles);
    if (!measuring_.over()) measure_evaluation(jammed.states.back(), particles);
  }

  /// Mean time over several equilibria. A single one may include a rearrangement, which can take many times as long.
  void measure_equilibria(const JammedSolid& jammed, const MinimiseOptions& options, int particles) {
    std::map<std::string, int> reasons;
    double total = 0;
    int count = 0;
    bool fine = true;
    for (const double distance : config_.distances) {
      const auto start = start_at(jammed, distance);
      if (!start) continue;
      Packing packing = start->equilibrium;
      MinimiseSummary summary;
      const auto taken = timed(measuring_, [&] {
        const Deadline deadline(measuring_.config.point_seconds, measuring_.stop);
        PackingEnergy energy;
        packing = start->equilibrium;
        summary = follow_equilibrium(packing, start->density, start->distance, energy, options, deadline.token());
      });
      if (measuring_.over()) return;
      total += spread(taken)->median;
      ++count;
      ++reasons[std::string(to_string(summary.reason))];
      fine &= is_equilibrium(summary);
    }
    if (count > 0) timed_["equilibrium"].add(particles, total / count, reasons, fine);
  }

  void measure_evaluation(const Packing& packing, int particles) {
    PackingEnergy energy;
    energy.evaluate(packing);  // not timed: the first evaluation finds the neighbours, which are then kept
    const auto taken = timed(measuring_, [&] {
      for (int k = 0; k < evaluations_timed; ++k) energy.evaluate(packing);
    });
    timed_["evaluation"].add(particles, spread(taken)->median / evaluations_timed, {{"done", 1}}, true);
  }

  void report(const std::string& task) {
    for (const std::string method : methods) {
      const Timed& timed = timed_[method];
      for (const auto& [particles, seconds] : timed.by_size) {
        family_.points.push_back({task,
                                  method,
                                  fmt::format("particles {}", particles),
                                  spread(seconds),
                                  {},
                                  reasons_text(timed.reasons.at(particles)),
                                  timed.failed.at(particles),
                                  {{"particles", particles}}});
      }
      const auto law = fit_power_law(timed.particles, timed.seconds);
      if (!law) continue;
      const auto half_width = law->points > 2 ? std::optional(law->ci95_half_width) : std::nullopt;
      family_.fits.push_back({task, method, law->exponent, law->prefactor, half_width, law->points});
    }
  }

  const Measuring& measuring_;
  const GrowthConfig& config_;
  ChartFamily& family_;
  std::map<std::string, Timed> timed_;
};

}  // namespace

void measure_growth(const Measuring& measuring, ChartFamily& family) { Growth(measuring, family).run(); }

}  // namespace isojam
