#pragma once

#include <string_view>

#include "tasks/json/place.hpp"
#include "tasks/replicate/replicate.hpp"
#include "tasks/system/process.hpp"

namespace isojam {

inline constexpr std::string_view checkpoint_schema = "isojam.checkpoint.v4";

/// All that a replicate needs to go on, and what it belongs to: specification, manifest and build. nullopt where a
/// number is not finite that should be; such a run is about to end.
std::optional<Json> make_checkpoint(const ReplicateSpec& spec, const Checkpoint& checkpoint);

/// The process that wrote a checkpoint.
ProcessId read_writer(const JsonPlace& root);

/// Reads back a checkpoint, bit for bit. Throws InputError if it is none, or one of another replicate, manifest or
/// build: another build may round differently, and the bits would depend on when the replicate was interrupted.
Checkpoint read_checkpoint(const JsonPlace& root, const ReplicateSpec& spec);

}  // namespace isojam
