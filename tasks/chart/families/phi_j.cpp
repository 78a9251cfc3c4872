#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <optional>

#include "engine/random/stream.hpp"
#include "tasks/chart/families/comparisons.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {
namespace {

/// The replicates of one setting of the protocol.
struct Replicated {
  std::vector<std::vector<EnergyPoint>> energies;  ///< of those that jammed
  std::vector<double> seconds;                     ///< of all
  int failed = 0;
};

struct ProtocolSetting {
  std::string name;
  int particles = 0;
  JamOptions options;
};

ProtocolSetting first_setting(const PhiJConfig& config) {
  ProtocolSetting setting{"first", config.particles.front(), {}};
  setting.options.consolidation_step = config.consolidation_step.front();
  setting.options.target_energy = config.target_energy.front();
  setting.options.fit_window = config.fit_window.front();
  setting.options.minimise.residual = config.residual.front();
  return setting;
}

/// One parameter at a time is moved away from the first setting; fit windows need no run of their own.
std::vector<ProtocolSetting> varied_settings(const PhiJConfig& config) {
  std::vector<ProtocolSetting> all;
  const auto vary = [&](std::string_view name, const auto& values, const auto& set) {
    for (std::size_t k = 1; k < values.size(); ++k) {
      ProtocolSetting setting = first_setting(config);
      setting.name = fmt::format("{} {:g}", name, static_cast<double>(values[k]));
      set(setting, values[k]);
      all.push_back(std::move(setting));
    }
  };
  vary("particles", config.particles, [](auto& setting, int n) { setting.particles = n; });
  vary("consolidation_step", config.consolidation_step,
       [](auto& setting, double step) { setting.options.consolidation_step = step; });
  vary("target_energy", config.target_energy,
       [](auto& setting, double energy) { setting.options.target_energy = energy; });
  vary("residual", config.residual,
       [](auto& setting, double residual) { setting.options.minimise.residual = residual; });
  return all;
}

Replicated replicated(const ProtocolSetting& setting, const Measuring& measuring) {
  const PhiJConfig& config = measuring.config.phi_j;
  Replicated result;
  for (int k = 0; k < config.replicates && !measuring.over(); ++k) {
    measuring.console.tick(fmt::format("jamming density, {}, replicate {}", setting.name, k + 1));
    RandomStream random{measuring.config.seed, static_cast<std::uint64_t>(config.solid),
                        static_cast<std::uint64_t>(setting.particles), static_cast<std::uint64_t>(k)};
    const double before = thread_cpu_seconds();
    Packing placed = random_packing(platonic(config.solid), setting.particles, setting.options.initial_density, random);
    const JamResult jammed = jam(std::move(placed), setting.options, measuring.stop);
    result.seconds.push_back(thread_cpu_seconds() - before);
    if (jammed.phi_j) {
      result.energies.push_back(energy_points(jammed));
    } else {
      ++result.failed;
    }
  }
  return result;
}

std::vector<double> densities(const Replicated& replicates, double window) {
  std::vector<double> values;
  for (const auto& energies : replicates.energies) {
    if (const auto found = fit_jamming_point(energies, window)) values.push_back(found->density);
  }
  return values;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Error: how far the mean is from `best` at the far end of its 95 % interval. Seconds: of all replicates together.
ChartPoint point_of(std::string task, std::string setting, const std::vector<double>& values, double seconds,
                    double best, int failed) {
  ChartPoint point{std::move(task), "protocol", std::move(setting), spread({seconds}), {},
                   "done",          failed > 0, Json::object()};
  point.further = {{"replicates", values.size()}, {"phi_j", nullptr}, {"half_width", nullptr}};
  if (failed > 0) point.stopped = fmt::format("{} not jammed", failed);
  const auto half_width = student_half_width(values);
  if (!half_width) {
    point.failed = true;
    point.stopped = "fewer than two replicates";
    return point;
  }
  point.error = Spread{std::abs(mean(values) - best) + *half_width, 0, 0, static_cast<int>(values.size())};
  point.error->least = std::abs(mean(values) - best);
  point.error->greatest = point.error->median;
  point.further["phi_j"] = mean(values);
  point.further["half_width"] = *half_width;
  return point;
}

double total(const std::vector<double>& seconds) { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }

/// Fewer replicates, and other windows, of what was run already.
void add_points_of_first(const Replicated& first, const PhiJConfig& config, const std::string& task,
                         ChartFamily& family) {
  const auto values = densities(first, config.fit_window.front());
  const double best = mean(values);
  for (std::size_t n = 2; n <= values.size(); ++n) {
    const std::vector<double> some(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(n));
    const std::vector<double> taken(first.seconds.begin(), first.seconds.begin() + static_cast<std::ptrdiff_t>(n));
    family.points.push_back(point_of(task, fmt::format("{} replicates", n), some, total(taken), best, first.failed));
  }
  for (std::size_t k = 1; k < config.fit_window.size(); ++k) {
    const double window = config.fit_window[k];
    family.points.push_back(point_of(task, fmt::format("fit_window {:g}", window), densities(first, window),
                                     total(first.seconds), best, first.failed));
  }
}

}  // namespace

void compare_protocols(const Measuring& measuring, ChartFamily& family) {
  const PhiJConfig& config = measuring.config.phi_j;
  const ProtocolSetting setting = first_setting(config);
  const Replicated first = replicated(setting, measuring);
  const auto values = densities(first, config.fit_window.front());
  if (measuring.over() || values.empty()) return;
  const auto task = fmt::format("{}, N = {}", to_string(config.solid), setting.particles);
  add_points_of_first(first, config, task, family);
  for (const ProtocolSetting& other : varied_settings(config)) {
    const Replicated replicates = replicated(other, measuring);
    if (measuring.over()) return;
    family.points.push_back(point_of(task, other.name, densities(replicates, other.options.fit_window),
                                     total(replicates.seconds), mean(values), replicates.failed));
  }
}

}  // namespace isojam
