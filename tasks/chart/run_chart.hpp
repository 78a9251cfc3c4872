#pragma once

#include <functional>
#include <stop_token>

#include "tasks/chart/config/config.hpp"
#include "tasks/chart/results/chart_result.hpp"
#include "tasks/system/console.hpp"

namespace isojam {

/// Called with the results so far after each part of a chart, until a stop. Parts not yet measured are marked as
/// interrupted and empty.
using PublishChart = std::function<void(const ChartResult& so_far)>;

/// Runs every requested comparison on the calling thread, in the order of Comparison. A family or atlas that was cut by
/// the time limit or a stop request is marked and keeps the points measured so far. Everything except times, and the
/// effects of time limits, is a function of the configuration.
ChartResult run_chart(const ChartConfig& config, std::stop_token stop, Console& console,
                      const PublishChart& publish = {});

}  // namespace isojam
