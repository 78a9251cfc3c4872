#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tasks/record.hpp"
#include "tasks/statistics.hpp"

namespace isojam {

using Estimates = std::array<Estimate, all_columns.size()>;

/// Estimates at one distance above jamming; those of replicates are empty.
struct SeriesPoint {
  double delta_phi = 0;
  Estimates estimates, unflagged;
};

/// One sweep point.
// NOLINTNEXTLINE(bugprone-exception-escape): moving a Json is noexcept; the check sees its assertions throw.
struct Row {
  SolidKind solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;     ///< the other swept values
  int replicates = 0;  ///< recorded, the failed ones included
  int failed = 0;
  int flagged = 0;                  ///< did not fail, count in the estimates, but their records hold a reservation
  Estimates estimates;              ///< over replicates that did not fail and have the value
  Estimates unflagged;              ///< the same without the flagged replicates
  std::vector<SeriesPoint> series;  ///< at those of series_distances that a replicate's states enclose
  std::optional<double> residual;   ///< worst of the states behind φ_J; nullopt if all failed
};

/// Rows in order of solid, particles, parameters.
struct Table {
  std::vector<Row> rows;
};

/// Pure; the order of the records does not matter. A record that is given twice counts once.
/// Throws InputError if records of one point were made with different settings, or if two records of the same
/// replicate disagree.
Table aggregate(std::span<const RecordSummary> records);

}  // namespace isojam
