#pragma once

#include <string_view>

#include "tasks/io/json.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {

inline constexpr std::string_view record_schema = "isojam.replicate.v4";
inline constexpr std::string_view path_schema = "isojam.path.v2";
inline constexpr std::string_view packing_schema = "isojam.packing.v3";

/// Makes the record of an outcome that was not interrupted. If the replicate failed, the values that were not computed
/// are null, with a reason. Two runs of the same replicate by the same build may differ only in `timing`.
Json make_record(const Outcome& outcome);

/// The hash of a record without timing, provenance and checksums. Two runs of the same replicate have the same hash.
std::string result_digest(const Json& record);

/// Makes a record to which measures were added. `record` contains all measures, and `before` is the record before the
/// addition. The result keeps the provenance and the timing of `before`. It also states which measures were added, the
/// build that added them, and the digests of `before`.
Json with_added(Json record, const Json& before, const std::vector<Measure>& added);

/// Makes the record of a replicate that failed before any measure, for a specification with more measures than
/// `before`.
Json failed_record(const Json& before, const ReplicateSpec& spec);

/// Makes the document of the state nearest jamming, for an outcome without failure and the record with this digest.
Json make_packing(const Outcome& outcome, const std::string& result_digest);
/// Makes the document with all states of the decompression, in order, each with its Δφ.
Json make_path(const Outcome& outcome, const std::string& result_digest);

/// Parts that records and checkpoints have in common.
Json provenance(const ReplicateSpec& spec);
Json to_json(const Timing& timing);

}  // namespace isojam
