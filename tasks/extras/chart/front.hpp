#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tasks/extras/chart/point.hpp"

namespace isojam {

/// Indices of the Pareto front of the points of one task, in the order of time. The front consists of the successful
/// points that no other point dominates. A point dominates another one if its median time and its median error are not
/// greater, and at least one of them is smaller. If several points have equal time and error, only the first is on the
/// front.
std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points);

}  // namespace isojam
