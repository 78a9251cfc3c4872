#pragma once

#include <string_view>

#include "tasks/io/place.hpp"
#include "tasks/io/process.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {

inline constexpr std::string_view checkpoint_schema = "isojam.checkpoint.v4";

/// Makes the document of a checkpoint: the state from which the replicate can be resumed, its specification, and the
/// digest of the manifest and the build to which it belongs. nullopt if a number is not finite; the run then ends soon
/// with a failure.
std::optional<Json> make_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint);

/// Reads which process wrote a checkpoint.
ProcessId read_writer(const JsonPlace& root);

/// Reads a checkpoint with all bits of the original. Throws InputError if the document is not a checkpoint, or belongs
/// to another replicate, manifest or build. Another build may round differently, so the result would depend on the
/// moment of the interruption.
Checkpoint read_checkpoint(const JsonPlace& root, const ReplicateSpec& spec);

}  // namespace isojam
