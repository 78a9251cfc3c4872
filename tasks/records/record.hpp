#pragma once

#include <string_view>

#include "tasks/io/json.hpp"
#include "tasks/records/document.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {

inline constexpr std::string_view record_schema = "isojam.record.v5";
inline constexpr std::string_view path_schema = "isojam.path.v3";
inline constexpr std::string_view packing_schema = "isojam.packing.v4";

/// Makes the record of an outcome that was not interrupted. If the replicate failed, the record states the reason. The
/// records of two runs of a replicate by the same build differ at most in `timing`.
Record record_of(const Outcome& outcome);
/// The JSON of this record, with its digest.
Json make_record(const Outcome& outcome);

/// True if the result digest of a record depends on this key of the record.
bool is_in_result_digest(std::string_view key);

/// The hash of a record without timing, provenance and checksum. Records with the same result have the same hash.
std::string result_digest(const Json& record);

/// Makes a record to which measures were added. `record` is a record with all measures, and `before` is the record
/// before the addition. The returned record has the provenance of `before` and the sum of the times of both.
/// It also states which measures were added, which build added them, and the digests of `before`.
Json with_added(Record record, const Record& before, const std::vector<Measure>& added);

/// Makes the record of a replicate that failed before any measure. It is equal to `before`, except that it has the
/// measures of `spec`, and the times and the build of the addition.
Record failed_record(Record before, const ReplicateSpec& spec);

/// Makes the document of a packing file, with the nearest state. The replicate must not have failed. `result_digest` is
/// the digest of its record.
Json make_packing(const Outcome& outcome, const std::string& result_digest);
/// Makes the document of a path file, with all states of the decompression and their Δφ. The conditions are the same as
/// for make_packing().
Json make_path(const Outcome& outcome, const std::string& result_digest);

}  // namespace isojam
