#pragma once

#include <functional>
#include <stop_token>

#include "tasks/extras/chart/chart_result.hpp"
#include "tasks/extras/chart/config.hpp"
#include "tasks/io/console.hpp"

namespace isojam {

/// Function that is called with the results so far after each part of a chart, until the chart is stopped. Parts that
/// have not been measured are empty and marked as interrupted.
using PublishChart = std::function<void(const ChartResult& so_far)>;

/// Runs all requested comparisons on the calling thread, in the order of Comparison. If the time limit or a stop
/// request ends a family or the atlas, it keeps the points that were measured and is marked as incomplete. Except for
/// times and the effects of time limits, the result depends only on the configuration.
ChartResult run_chart(const ChartConfig& config, std::stop_token stop, Console& console,
                      const PublishChart& publish = {});

}  // namespace isojam
