#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/records/recorded.hpp"

namespace isojam {

// A results directory is a set of replicates. Each record states the specification from which it was computed. A
// manifest is a request for a list of specifications. The directory keeps the manifests that were run in it:
// manifest.json is the last one, and the folder manifests/ has all of them, as NAME-DATE.json.

/// Function that receives warnings.
using Warn = std::function<void(const std::string&)>;

/// The plans of the manifests that were run in a directory, the last one first. Empty if the directory has no manifest.
using Requests = std::vector<Plan>;

/// Reads the manifests of a directory. Warns about a damaged manifest in manifests/, and skips it. Throws the
/// exceptions of stored_manifest().
Requests requests_in(const std::filesystem::path& directory, const Warn& warn);

/// The specification that the last manifest with this sweep point gives to a replicate; nullopt if no manifest has the
/// sweep point. The number of the replicate may be larger than any manifest requests.
std::optional<ReplicateSpec> requested(const Requests& requests, std::string_view name);

/// True if a manifest requests the replicate with this name and this digest of its specification.
bool is_requested(const Requests& requests, std::string_view name, const std::string& digest);

/// Relation of a record to the specification that requested() gives to its name, or to the digest of it.
enum class Standing {
  requested,   ///< the record has this specification
  superseded,  ///< the record has another one and failed, so that the next run replaces it
  foreign      ///< the record has another one, or there is none
};
Standing standing_of(const RecordedReplicate& replicate, const std::optional<std::string>& digest);

/// True if the plans give different specifications to a replicate.
bool are_in_conflict(const Plan& one, const Plan& other);

/// The error for a record that has another specification than the manifest gives to its name. It states the key that
/// differs and both values.
InputError conflict_of(const std::filesystem::path& directory, const RecordedReplicate& replicate,
                       const ReplicateSpec& spec);

/// Makes a manifest the last one of a directory, and writes nothing if it already is. Keeps the previous manifest.json
/// in manifests/ too, because a directory of an earlier version has it only there.
void request(const std::filesystem::path& directory, const Manifest& manifest);

}  // namespace isojam
