#pragma once

#include <string>

#include "tasks/aggregate.hpp"

namespace isojam {

inline constexpr std::string_view table_schema = "isojam.tables.v1";

/// tables.json.
Json to_json(const Table& table);

/// For people: aligned columns, mean ± half width of the 95 % interval, (n) where fewer replicates have the value
/// than did not fail.
std::string to_text(const Table& table);

/// One line per row; for each quantity mean, ci95 low and high, sd, n, bootstrap95 low and high. Empty: no value.
std::string to_csv(const Table& table);

/// A tabular environment.
std::string to_latex(const Table& table);

}  // namespace isojam
