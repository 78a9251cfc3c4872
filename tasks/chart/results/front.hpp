#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "tasks/chart/results/point.hpp"

namespace isojam {

/// The Pareto front of points of one task: those that did not fail and that no other one beats, by median time and
/// median error both no greater and one of them less. Indices in order of time; of points equal in both, the first.
std::vector<std::size_t> pareto_front(std::span<const ChartPoint> points);

}  // namespace isojam
