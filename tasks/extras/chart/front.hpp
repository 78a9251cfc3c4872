#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tasks/extras/chart/point.hpp"

namespace isojam {

/// Indices of the points on the Pareto front of one task, sorted by time. Points that failed, or that have no time or
/// error, are ignored. A point is on the front if no other point dominates it. A point dominates another one if it is
/// better in time or error, and not worse in the other quantity. Times and errors are medians. If several points have
/// the same time and error, only the first is on the front.
std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points);

}  // namespace isojam
