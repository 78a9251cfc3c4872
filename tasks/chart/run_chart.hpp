#pragma once

#include <functional>
#include <stop_token>

#include "tasks/chart/config/config.hpp"
#include "tasks/chart/results/chart_result.hpp"
#include "tasks/system/console.hpp"

namespace isojam {

/// Called with what there is after each part of a chart, until it is to stop; what is still to come stands in it as
/// interrupted and empty.
using PublishChart = std::function<void(const ChartResult& so_far)>;

/// Runs every comparison asked for, on the calling thread alone, in the order of Comparison. A family in which the
/// total time ran out, or that a stop request ended, says so and holds the points measured until then; so does the
/// atlas. All but the times, and what ends by time, is a function of the configuration.
ChartResult run_chart(const ChartConfig& config, std::stop_token stop, Console& console,
                      const PublishChart& publish = {});

}  // namespace isojam
