#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numeric>

#include "engine/random/stream.hpp"
#include "tasks/extras/chart/comparisons.hpp"
#include "tasks/tables/statistics.hpp"

namespace isojam {
namespace {

/// The replicates that were run with one setting of the protocol.
struct Replicated {
  std::map<int, std::vector<EnergyPoint>> energies;  ///< states of the jammed replicates, by number of the replicate
  std::vector<double> seconds;                       ///< CPU time of every replicate, by number

  int count() const { return static_cast<int>(seconds.size()); }
  /// CPU time of the replicates with a number below `first`.
  double total_seconds(int first) const { return std::accumulate(seconds.begin(), seconds.begin() + first, 0.0); }
  int failed(int first) const {
    return first - static_cast<int>(std::distance(energies.begin(), energies.lower_bound(first)));
  }
};

struct ProtocolSetting {
  std::string name;
  int particles = 0;
  JamOptions options;
};

ProtocolSetting first_setting(const PhiJConfig& config) {
  ProtocolSetting setting{"first", config.particles.front(), {}};
  setting.options.compression.step = config.consolidation_step.front();
  setting.options.compression.target_energy = config.target_energy.front();
  setting.options.decompression.fit_window = config.fit_window.front();
  setting.options.minimise.residual = config.residual.front();
  return setting;
}

/// Settings that differ from the first one in one parameter. Other fit windows need no further run and are not listed
/// here.
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
       [](auto& setting, double step) { setting.options.compression.step = step; });
  vary("target_energy", config.target_energy,
       [](auto& setting, double energy) { setting.options.compression.target_energy = energy; });
  vary("residual", config.residual,
       [](auto& setting, double residual) { setting.options.minimise.residual = residual; });
  return all;
}

Replicated replicated(const ProtocolSetting& setting, const Measuring& measuring) {
  const PhiJConfig& config = measuring.config.phi_j;
  Replicated result;
  for (int k = 0; k < config.replicates && !measuring.over(); ++k) {
    measuring.progress(fmt::format("jamming density, {}, replicate {}", setting.name, k + 1));
    RandomStream random{measuring.config.seed, static_cast<std::uint64_t>(config.solid),
                        static_cast<std::uint64_t>(setting.particles), static_cast<std::uint64_t>(k)};
    const double before = thread_cpu_seconds();
    Packing placed =
        random_packing(platonic(config.solid), setting.particles, setting.options.compression.initial_density, random);
    const JamResult jammed = jam(std::move(placed), setting.options, measuring.stop);
    result.seconds.push_back(thread_cpu_seconds() - before);
    if (jammed.phi_j) result.energies.emplace(k, energy_points(jammed));
  }
  return result;
}

/// φ_J by number of the replicate.
using Densities = std::map<int, double>;

Densities densities(const Replicated& replicates, double window) {
  Densities values;
  for (const auto& [number, energies] : replicates.energies) {
    if (const auto found = fit_jamming_point(energies, window)) values.emplace(number, found->density);
  }
  return values;
}

/// The entries for replicates with a number below `count`.
Densities first_of(const Densities& densities, int count) { return {densities.begin(), densities.lower_bound(count)}; }

std::vector<double> values_of(const Densities& densities) {
  std::vector<double> values;
  for (const auto& [number, density] : densities) values.push_back(density);
  return values;
}

/// Differences between replicates with the same number. They start from the same initial configuration if N is the
/// same.
std::vector<double> differences(const Densities& densities, const Densities& first) {
  std::vector<double> values;
  for (const auto& [number, density] : densities) {
    if (const auto other = first.find(number); other != first.end()) values.push_back(density - other->second);
  }
  return values;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// A setting of the protocol with its φ_J and its cost.
struct Compared {
  std::string task, setting;
  Densities densities;
  double seconds = 0;  ///< CPU time of all replicates
  int failed = 0;
  bool began_alike = true;
};

/// The point of a setting. Its error is the distance from the mean of `first` to the far end of the 95 % confidence
/// interval.
ChartPoint point_of(const Compared& compared, const Densities& first) {
  ChartPoint point{compared.task, "protocol",          compared.setting, spread({compared.seconds}), {},
                   "done",        compared.failed > 0, Json::object()};
  const auto values = values_of(compared.densities);
  point.further = {{"replicates", values.size()},
                   {"phi_j", nullptr},
                   {"half_width", nullptr},
                   {"difference", nullptr},
                   {"difference_half_width", nullptr}};
  if (compared.failed > 0) point.stopped = fmt::format("{} not jammed", compared.failed);
  const auto half_width = student_half_width(values);
  if (!half_width) {
    point.failed = true;
    point.stopped = "fewer than two replicates";
    return point;
  }
  const double off = mean(values) - mean(values_of(first));
  point.error =
      Spread{std::abs(off) + *half_width, std::abs(off), std::abs(off) + *half_width, static_cast<int>(values.size())};
  point.further["phi_j"] = mean(values);
  point.further["half_width"] = *half_width;
  const auto paired = compared.began_alike ? differences(compared.densities, first) : std::vector<double>();
  if (const auto width = student_half_width(paired)) {
    point.further["difference"] = mean(paired);
    point.further["difference_half_width"] = *width;
  }
  return point;
}

class Protocols {
 public:
  Protocols(const Measuring& measuring, ChartFamily& family)
      : measuring_(measuring), config_(measuring.config.phi_j), family_(family) {}

  void run() {
    const ProtocolSetting setting = first_setting(config_);
    task_ = fmt::format("{}, N = {}", to_string(config_.solid), setting.particles);
    family_.note += fmt::format(
        " First setting: particles {}, consolidation_step {:g}, target_energy {:g}, fit_window {:g}, residual {:g}.",
        setting.particles, setting.options.compression.step, setting.options.compression.target_energy,
        setting.options.decompression.fit_window, setting.options.minimise.residual);
    const Replicated first = replicated(setting, measuring_);
    first_ = densities(first, config_.fit_window.front());
    if (measuring_.over() || first_.empty()) return;
    add_points_of(first);
    for (const ProtocolSetting& other : varied_settings(config_)) {
      const Replicated replicates = replicated(other, measuring_);
      if (measuring_.over()) return;
      add(other.name, densities(replicates, other.options.decompression.fit_window), replicates, replicates.count(),
          other.particles == setting.particles);
    }
  }

 private:
  void add(const std::string& setting, Densities densities, const Replicated& replicates, int count, bool alike) {
    const Compared compared{
        task_, setting, std::move(densities), replicates.total_seconds(count), replicates.failed(count), alike};
    family_.points.push_back(point_of(compared, first_));
  }

  /// Adds points that need no further run: all replicates of the first setting, the first n of them, and other fit
  /// windows.
  void add_points_of(const Replicated& first) {
    for (int n = first.count(); n >= 2; --n) {
      const auto name = fmt::format("{}replicates {}", n == first.count() ? "first setting, " : "", n);
      add(name, first_of(first_, n), first, n, false);
    }
    for (std::size_t k = 1; k < config_.fit_window.size(); ++k) {
      const double window = config_.fit_window[k];
      add(fmt::format("fit_window {:g}", window), densities(first, window), first, first.count(), true);
    }
  }

  const Measuring& measuring_;
  const PhiJConfig& config_;
  ChartFamily& family_;
  std::string task_;
  Densities first_;
};

}  // namespace

void compare_protocols(const Measuring& measuring, ChartFamily& family) { Protocols(measuring, family).run(); }

}  // namespace isojam
