#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tasks/aggregate.hpp"
#include "tasks/replicate.hpp"

namespace isojam {

/// To stdout.
void print(std::string_view text);

/// The table of all records in results directories.
Table table_of(const std::vector<std::string>& directories);

/// One line about the last step of a replicate.
std::string step_text(const ReplicateSpec& spec, const JamProgress& progress);

/// "3.2 GB", "45 kB".
std::string bytes_text(double bytes);

}  // namespace isojam
