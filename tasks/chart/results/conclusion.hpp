#pragma once

#include <array>
#include <span>
#include <string>

#include "tasks/chart/results/point.hpp"

namespace isojam {

/// Number of tasks and time in which a method reaches a residual.
struct Standing {
  std::string method;
  int reached = 0, tasks = 0;  ///< tasks in which a point's greatest residual is within the limit, and tasks tried
  double seconds = 0;          ///< over the reached tasks, each by its fastest setting
};

/// Ranks the methods of equilibrium points by `residual`: by number of tasks reached, then by time. A setting that
/// failed may still be within it.
std::vector<Standing> standings(std::span<const ChartPoint> points, double residual);

/// Three lines: the fastest method within 1e-6, the fastest within 1e-9, and for every requested residual the methods
/// that missed it, with the residuals of the paper's rule. All count cases by the same criterion: within a residual, or
/// not. `bias`: points of that family, for the same variants.
std::array<std::string, 3> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias);

}  // namespace isojam
