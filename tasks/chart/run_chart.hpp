#pragma once

#include <stop_token>
#include <vector>

#include "tasks/chart/config.hpp"
#include "tasks/chart/point.hpp"
#include "tasks/console.hpp"

namespace isojam {

/// Runs every comparison asked for, on the calling thread alone, in the order of Comparison. A family in which the
/// total time ran out, or that a stop request ended, says so and holds the points measured until then.
/// All but the times, and what ends by time, is a function of the configuration.
std::vector<ChartFamily> run_chart(const ChartConfig& config, std::stop_token stop, Console& console);

}  // namespace isojam
