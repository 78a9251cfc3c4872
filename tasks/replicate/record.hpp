#pragma once

#include <string_view>

#include "tasks/json/json.hpp"
#include "tasks/replicate/replicate.hpp"

namespace isojam {

inline constexpr std::string_view record_schema = "isojam.replicate.v3";
inline constexpr std::string_view path_schema = "isojam.path.v2";
inline constexpr std::string_view packing_schema = "isojam.packing.v3";

/// The record of an outcome that was not interrupted; what a failed one lacks is null with a reason. Only `timing` may
/// differ between two runs of the same replicate by the same build.
Json make_record(const Outcome& outcome);

/// The hash of all of a record but timing, provenance and what vouches for it: equal for two runs of one replicate.
std::string result_digest(const Json& record);

/// The record of an outcome that was made of `before` by adding measures: what that one says of its run and of the time
/// it took, and beside it what was added, by whom, and what the record was until then.
Json with_added(Json record, const Json& before, const std::vector<Measure>& added);

/// The record of a replicate that failed before anything was measured, as it would be if more had been asked for.
Json failed_record(const Json& before, const ReplicateSpec& spec);

/// The state nearest jamming of an outcome without failure, for the record that has this digest.
Json make_packing(const Outcome& outcome, const std::string& result_digest);
/// Every state of the expansion, in order, each with its Δφ.
Json make_path(const Outcome& outcome, const std::string& result_digest);

/// Parts of records and checkpoints alike.
Json provenance(const ReplicateSpec& spec);
Json to_json(const Timing& timing);

}  // namespace isojam
