#pragma once

#include <map>

#include "tasks/report/view.hpp"
#include "tasks/store/results.hpp"

namespace isojam {

/// Everything that the page shows, as a value: pure and the same for the same files.
///   manifest    {"name", "seed"} as texts, null where unknown
///   exclude     flags of replicates that count in no mean
///   builds      distinct provenance of the records
///   measures    what was measured, over all records
///   addable     what else could be, from the expansions that were kept; null where none were
///   columns     {"name", "group", "unit", "latex"} of the quantities, in the order of the tables
///   parameters  names of the swept ones, each with what its column is called
///   rows        those of tables.json, each with "label", "paper" (φ_J of Table I or null), "scaling" (power laws of
///               ⟨ω⟩ over its replicates) and "angles" (CDFs over its replicates), both without the excluded
///   csv, latex  the same table as text
///   replicates  of each: "name", "row", "status", "flags", "excluded", "failure", cost, "states", "line" (the
///               extrapolation)
///   solids      shapes and reference curves of the solids that occur
///   views       packing_view of `views`, with the name of the replicate
Json report_data(const Results& results, const std::map<std::size_t, Json>& views);

}  // namespace isojam
