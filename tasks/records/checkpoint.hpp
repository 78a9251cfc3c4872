#pragma once

#include <string_view>

#include "tasks/io/place.hpp"
#include "tasks/io/process.hpp"
#include "tasks/records/replicate.hpp"

namespace isojam {

inline constexpr std::string_view checkpoint_schema = "isojam.checkpoint.v5";

/// Makes the JSON document of a checkpoint: the progress of the replicate, its specification without measures, the
/// build, and the process that writes it. Returns nullopt if a number of a strain step is not finite; such a run soon
/// ends with a failure.
std::optional<Json> make_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint);

/// The process that wrote a checkpoint.
ProcessId read_writer(const JsonPlace& root);

/// Reads a checkpoint with all bits of the original. Throws InputError if the document is not a checkpoint, or if the
/// checkpoint belongs to another replicate, manifest or build. The manifest may differ in its measures. The build must
/// be the same, because another build may round differently; the result would then depend on the time of the
/// interruption.
Checkpoint read_checkpoint(const JsonPlace& root, const ReplicateSpec& spec);

}  // namespace isojam
