#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tasks/chart/results/point.hpp"

namespace isojam {

/// Pareto front of the points of one task: successful points that no other point dominates (median time and median
/// error not greater, and one of them less). Indices in order of time; of points equal in both, the first.
std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points);

}  // namespace isojam
