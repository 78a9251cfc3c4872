#pragma once

#include <map>

#include "tasks/extras/report/view.hpp"
#include "tasks/records/results.hpp"

namespace isojam {

/// Makes the data of the report. It has no side effects, and the result is the same for the same files.
///  manifest    {"name", "seed"} as texts, null where unknown
///  exclude     flags of replicates that count in no mean
///  builds      distinct provenance of the records
///  measures    measures, over all records
///  addable     measures that could be added from stored expansions; null if there are none
///  columns     {"name", "group", "unit", "latex"} of the quantities, in the order of the tables
///  parameters  names of the swept parameters, each with the heading of its column
///  rows        those of tables.json, each with "label", "paper" (φ_J of Table I or null), "scaling" (power laws of
///              ⟨ω⟩ over its replicates) and "angles" (CDFs over its replicates), both without excluded replicates
///  csv, latex  the same table as text
///  replicates  for each: "name", "row", "status", "flags", "excluded", "failure", cost, "states", "line" (the
///              extrapolation)
///  solids      shapes and reference curves of the solids that occur
///  views       packing_view of `views`, with the name of the replicate
Json report_data(const Results& results, const std::map<std::size_t, Json>& views);

}  // namespace isojam
