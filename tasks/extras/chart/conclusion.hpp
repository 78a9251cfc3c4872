#pragma once

#include <span>
#include <string>
#include <vector>

#include "tasks/extras/chart/point.hpp"

namespace isojam {

/// Result of a method: in how many tasks it reaches a residual, and how much time it needs.
struct Standing {
  std::string method;
  /// number of tasks in which at least one setting of the method reaches the residual in all packings, and number of
  /// tasks that were tried
  int reached = 0, tasks = 0;
  double seconds = 0;  ///< sum of the times of the reached tasks, each with the fastest of these settings
};

/// Ranks the methods in the family `equilibrium` for a residual: first by the number of tasks in which they reach it,
/// then by time. A setting may reach this residual even if it failed to reach the residual that it requested.
std::vector<Standing> standings(std::span<const ChartPoint> points, double residual);

/// Makes lines of text, with whole sentences, in which tasks are called cases. There is one line for each residual that
/// was requested, largest first. It states which methods of the family `equilibrium` reach the residual in all tasks,
/// which one is the fastest, and which ones miss it. If the paper's stopping rule was measured, the last line states
/// the residuals and the errors of φ_J with this rule. `bias` contains the points of the family `bias`.
std::vector<std::string> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias);

}  // namespace isojam
