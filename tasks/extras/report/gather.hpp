#pragma once

#include <map>

#include "tasks/extras/report/view.hpp"
#include "tasks/records/results.hpp"

namespace isojam {

/// Makes the data of the report. `views` are the packing_view() of some replicates, by the index of the replicate in
/// the results. The function has no side effects. The result has these keys:
/// - manifest: {"name", "seed"} as texts; null if unknown
/// - exclude: flags that exclude a replicate from means
/// - builds: provenance of the records; each one occurs once
/// - measures: measures that at least one record has
/// - addable: all other measures, which "isojam measure" can add
/// - keeps_paths: false if the manifest does not keep paths; "isojam measure" then adds measures only for the nearest
///   states
/// - columns: {"name", "group", "unit", "latex"} of all quantities, in the order of tables
/// - parameters: names of the swept parameters, and for each the heading of its column
/// - rows: the rows of tables.json. Each also has "label", "paper" (φ_J of Table I, or null), "scaling" (power laws of
///   ⟨ω⟩), "angles" (distributions of alignment angles) and "distributions" (see pooled_distributions()). Failed and
///   excluded replicates do not contribute to the last three.
/// - base: title of the table of paired differences; empty if there is no base
/// - csv, latex: the table as CSV and as LaTeX
/// - replicates: one object for each replicate, with "name", "row", "status", "flags", "excluded", "failure", "states",
///   "line" (the line that was extrapolated to φ_J) and other values
/// - solids: shapes and angle_references() of all solids and mixtures
/// - views: the elements of `views`, each with the name of its replicate
Json report_data(const Results& results, const std::map<std::size_t, Json>& views);

}  // namespace isojam
