#pragma once

#include <string>
#include <vector>

#include "tasks/store/store.hpp"
#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// The table of all records in results directories; what is left out, and that records are of different builds, is
/// told. Throws as for_each_record and Aggregation::add do.
Table table_of(const std::vector<std::string>& directories, const Warn& warn);

}  // namespace isojam
