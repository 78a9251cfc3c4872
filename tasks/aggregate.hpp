#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "tasks/record.hpp"
#include "tasks/statistics.hpp"

namespace isojam {

/// One sweep point.
struct Row {
  SolidKind solid = SolidKind::tetrahedron;
  int particles = 0;
  Json parameters;     ///< the other swept values
  int replicates = 0;  ///< recorded, the failed ones included
  int failed = 0;
  int flagged = 0;  ///< did not fail, count in the estimates, but their records hold a reservation
  std::array<Estimate, columns.size()> estimates;  ///< over replicates that did not fail and have the value
  std::array<Estimate, columns.size()> unflagged;  ///< the same without the flagged replicates
  std::optional<double> residual;                  ///< worst of the states behind φ_J; nullopt if all failed
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
