#pragma once

#include <array>
#include <span>
#include <string>

#include "tasks/chart/results/point.hpp"

namespace isojam {

/// A method as measured by how often and how fast it gets within a residual.
struct Standing {
  std::string method;
  int reached = 0, tasks = 0;  ///< tasks in which a point's greatest residual is within, of those it was tried on
  double seconds = 0;          ///< of those, each by its fastest setting
};

/// The methods of some equilibrium points by how they get within `residual`: those that reach more tasks first, the
/// faster first among equals. A setting that failed may be within all the same.
std::vector<Standing> standings(std::span<const ChartPoint> points, double residual);

/// Three lines: the fastest method within 1e-6, the fastest within 1e-9, and, for every residual that was asked for,
/// who missed it, with where the paper's rule ends. All count cases by the same measure: within a residual, or not.
/// `bias`: points of that family, for the same variants.
std::array<std::string, 3> conclusion(std::span<const ChartPoint> equilibrium, std::span<const ChartPoint> bias);

}  // namespace isojam
