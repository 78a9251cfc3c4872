#include "tasks/chart/run_chart.hpp"

#include <algorithm>
#include <iterator>

#include "tasks/chart/comparisons.hpp"
#include "tasks/graph.hpp"

namespace isojam {
namespace {

bool asked(const ChartConfig& config, Comparison comparison) {
  return std::find(config.compare.begin(), config.compare.end(), comparison) != config.compare.end();
}

std::vector<ChartFamily> compared(Comparison comparison, std::span<const JammedSolid> jammed,
                                  const Measuring& measuring) {
  switch (comparison) {
    case Comparison::equilibrium: return compare_minimisers(jammed, measuring);
    case Comparison::hessian: return {compare_hessians(jammed, measuring)};
    case Comparison::modes: return {compare_modes(jammed, measuring)};
    case Comparison::overlap: return {compare_overlaps(measuring)};
    case Comparison::phi_j: return {compare_protocols(measuring)};
  }
  return {};
}

std::vector<ChartFamily> measured(const Measuring& measuring, const std::stop_token& signal) {
  std::vector<ChartFamily> families;
  std::vector<JammedSolid> jammed;
  for (const Comparison comparison : all_comparisons) {
    if (!asked(measuring.config, comparison)) continue;
    const bool needs_packings = comparison <= Comparison::modes;
    if (needs_packings && jammed.empty()) jammed = jam_all(measuring);
    auto more = compared(comparison, jammed, measuring);
    for (ChartFamily& family : more) {
      if (measuring.over()) family.ended = signal.stop_requested() ? FamilyEnd::interrupted : FamilyEnd::cut;
    }
    std::move(more.begin(), more.end(), std::back_inserter(families));
  }
  return families;
}

}  // namespace

std::vector<ChartFamily> run_chart(const ChartConfig& config, std::stop_token stop, Console& console) {
  const Deadline deadline(config.total_seconds, stop);
  const Measuring measuring{config, deadline.token(), console};
  std::vector<ChartFamily> families;
  with_threads(1, [&] { families = measured(measuring, stop); });
  return families;
}

}  // namespace isojam
