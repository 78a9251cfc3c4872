#include "tasks/extras/chart/run_chart.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tasks/extras/chart/comparisons.hpp"
#include "tasks/run/graph.hpp"

namespace isojam {
namespace {

bool asked(const ChartConfig& config, Comparison comparison) {
  return std::find(config.compare.begin(), config.compare.end(), comparison) != config.compare.end();
}

/// A result that has all requested comparisons but no measurements yet.
ChartResult blank_result(const ChartConfig& config) {
  ChartResult result;
  for (const Comparison comparison : all_comparisons) {
    if (!asked(config, comparison)) continue;
    if (comparison == Comparison::atlas) result.atlas = ChartAtlas{FamilyEnd::interrupted, {}};
    for (ChartFamily& family : empty_families(comparison)) {
      family.ended = FamilyEnd::interrupted;
      result.families.push_back(std::move(family));
    }
  }
  return result;
}

class ChartRun {
 public:
  ChartRun(const Measuring& measuring, const std::stop_token& signal, const PublishChart& publish)
      : measuring_(measuring), signal_(signal), publish_(publish), result_(blank_result(measuring.config)) {}

  ChartResult run() {
    for (const Comparison comparison : all_comparisons) {
      if (!asked(measuring_.config, comparison)) continue;
      prepare_for(comparison);
      timed_part(std::string(to_string(comparison)), [&] { compare(comparison); });
      mark_end(comparison);
      if (publish_ && !measuring_.over()) publish_(result_);
    }
    return std::move(result_);
  }

 private:
  template <class Work>
  void timed_part(std::string part, const Work& work) {
    const double before = thread_cpu_seconds();
    work();
    result_.costs.push_back({std::move(part), thread_cpu_seconds() - before});
  }

  /// Computes the packings and equilibria that a comparison needs, unless an earlier comparison did.
  void prepare_for(Comparison comparison) {
    const bool needs_equilibria = comparison == Comparison::hessian || comparison == Comparison::modes;
    if ((needs_equilibria || comparison == Comparison::equilibrium) && !jammed_)
      timed_part("packings", [&] { jammed_ = jam_all(measuring_); });
    if (needs_equilibria && !equilibria_)
      timed_part("equilibria", [&] { equilibria_ = all_equilibria(*jammed_, measuring_); });
  }

  ChartFamily& family(std::string_view name) {
    return *std::find_if(result_.families.begin(), result_.families.end(),
                         [&](const ChartFamily& each) { return each.name == name; });
  }

  void compare(Comparison comparison) {
    switch (comparison) {
      case Comparison::equilibrium:
        return compare_minimisers(*jammed_, measuring_, family("equilibrium"), family("bias"));
      case Comparison::hessian: return compare_hessians(*equilibria_, measuring_, family("hessian"));
      case Comparison::modes: return compare_modes(*equilibria_, measuring_, family("modes"));
      case Comparison::overlap: return compare_overlaps(measuring_, family("overlap"));
      case Comparison::atlas: return measure_atlas();
    }
  }

  void measure_atlas() {
    AtlasOptions options;
    options.stop = measuring_.stop;
    options.progress = [this](const std::string& part) { measuring_.progress("stability atlas, " + part); };
    result_.atlas->rows = stability_atlas(options);
  }

  void mark_end(Comparison comparison) {
    FamilyEnd end = FamilyEnd::complete;
    if (measuring_.over()) end = signal_.stop_requested() ? FamilyEnd::interrupted : FamilyEnd::cut;
    if (comparison == Comparison::atlas) result_.atlas->ended = end;
    for (const ChartFamily& each : empty_families(comparison)) family(each.name).ended = end;
  }

  const Measuring& measuring_;
  const std::stop_token& signal_;
  const PublishChart& publish_;
  ChartResult result_;
  std::optional<std::vector<JammedSolid>> jammed_;
  std::optional<std::vector<TaskEquilibria>> equilibria_;
};

}  // namespace

ChartResult run_chart(const ChartConfig& config, std::stop_token stop, Console& console, const PublishChart& publish) {
  const Deadline deadline(config.total_seconds, stop);
  const Measuring measuring{config, deadline.token(), [&console](const std::string& next) { console.tick(next); }};
  ChartResult result;
  with_threads(1, [&] { result = ChartRun(measuring, stop, publish).run(); });
  return result;
}

}  // namespace isojam
