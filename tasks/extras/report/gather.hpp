#pragma once

#include <map>

#include "tasks/extras/report/view.hpp"
#include "tasks/records/results.hpp"

namespace isojam {

/// Makes the data of the report. `views` are the packing_view() of some replicates, by their index in the results. The
/// function has no side effects.
/// manifest    {"name", "seed"} as texts; null if unknown
/// exclude     flags that exclude a replicate from means
/// builds      provenance of the records; each one occurs once
/// measures    measures that at least one record has
/// addable     all other measures, which "isojam measure" can add; null if the manifest does not keep paths
/// columns     {"name", "group", "unit", "latex"} of all quantities, in the order of tables
/// parameters  names of the swept parameters, and for each the heading of its column
/// rows        the rows of tables.json without goals and differences, but with "label", "paper" (φ_J of Table I, or
/// null), "scaling" (power laws of ⟨ω⟩) and "angles" (distributions of alignment angles); the last two are
/// computed from all replicates of the row that neither failed nor are excluded
/// csv, latex  the table as CSV and as LaTeX
/// replicates  for each replicate: "name", "row", "status", "flags", "excluded", "failure", its cost, "states", "line"
/// (the line from which φ_J was extrapolated), and others
/// solids      shapes and angle_references() of all solids and mixtures
/// views       the elements of `views`, each with the name of its replicate
Json report_data(const Results& results, const std::map<std::size_t, Json>& views);

}  // namespace isojam
