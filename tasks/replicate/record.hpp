#pragma once

#include <string_view>

#include "tasks/json/json.hpp"
#include "tasks/replicate/replicate.hpp"

namespace isojam {

inline constexpr std::string_view record_schema = "isojam.replicate.v3";
inline constexpr std::string_view path_schema = "isojam.path.v1";
inline constexpr std::string_view packing_schema = "isojam.packing.v2";

/// The record of an outcome that was not interrupted. Only `timing` may differ between two runs of the same replicate
/// by the same build.
Json make_record(const Outcome& outcome);

/// The state nearest jamming of an outcome without failure.
Json make_packing(const Outcome& outcome);
/// Every state of the expansion, in order, each with its Δφ.
Json make_path(const Outcome& outcome);

/// Parts of records and checkpoints alike.
Json provenance(const ReplicateSpec& spec);
Json to_json(const Timing& timing);
Json to_json(const PairCounts& counts);
Json to_json(const MinimiseWork& work);

}  // namespace isojam
