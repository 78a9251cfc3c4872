#pragma once

#include <string>
#include <vector>

#include "tasks/tables/aggregate.hpp"

namespace isojam {

/// The table of all records in results directories. Throws as for_each_record and Aggregation::add do.
Table table_of(const std::vector<std::string>& directories);

}  // namespace isojam
