#pragma once

#include <functional>
#include <stop_token>

#include "tasks/extras/chart/data.hpp"
#include "tasks/io/console.hpp"

namespace isojam {

/// Function that is called after each comparison of a chart, with the results so far, unless the chart was stopped.
/// Comparisons that have not been measured yet have no points and are marked as interrupted.
using PublishChart = std::function<void(const ChartResult& so_far)>;

/// Runs all requested comparisons on the calling thread, in the order of Comparison. If the time limit or a stop
/// request ends a comparison, its results so far are kept and marked as incomplete. Apart from times and from the
/// effects of time limits, the result depends only on the configuration.
ChartResult run_chart(const ChartConfig& config, std::stop_token stop, Console& console,
                      const PublishChart& publish = {});

}  // namespace isojam
