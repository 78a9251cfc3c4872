#pragma once

#include <array>
#include <span>
#include <string>

#include "tasks/extras/chart/point.hpp"

namespace isojam {

/// Number of tasks in which a method reaches a residual, and the time that it needs.
struct Standing {
  std::string method;
  /// number of tasks in which the largest residual of a point is within the limit, and number of tasks that were tried
  int reached = 0, tasks = 0;
  double seconds = 0;  ///< time for all reached tasks, each with the fastest setting
};

/// Ranks the methods of the family `equilibrium` for a residual: by the number of tasks in which they reach it, then by
/// time. A setting that did not reach its own tolerance may still reach this residual.
std::vector<Standing> standings(std::span<const ChartPoint> points, double residual);

/// Makes three lines of text: the fastest method that reaches 1e-6, the fastest method that reaches 1e-9, and the
/// methods that miss each requested residual, together with the residuals of the paper's stopping rule. All lines use
/// the same criterion, whether a residual is reached. `bias` contains the points of the family `bias`.
std::array<std::string, 3> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias);

}  // namespace isojam
