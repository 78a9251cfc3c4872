#pragma once

#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/replicate/replicate.hpp"
#include "tasks/store/store.hpp"

namespace isojam {

/// A record that measures are added to.
struct Addition {
  ReplicateSpec spec;            ///< with all measures
  std::vector<Measure> lacking;  ///< of these, what the record has not
};

/// What there is to add to the records of a directory, those of `names`, for them to have all measures of its manifest.
struct Additions {
  std::vector<Addition> measured;         ///< from their paths
  std::vector<ReplicateSpec> failed;      ///< before anything was measured: their records say what else they have not
  std::vector<std::string> not_measured;  ///< names of those that failed in a measure, whose states were not kept
};

/// Throws InputError for a record that is damaged, of another manifest or not of the plan, and for one that could be
/// measured, had its path been kept; FileError for what cannot be read now.
Additions additions(const std::filesystem::path& directory, const Plan& plan, const std::vector<std::string>& names);

/// The stages by which a replicate gets what its record lacks: its run is read back from record and path, states are
/// followed to minima if that is needed for the first time, and what was measured before is taken from the record
/// unless that moved a state.
Stages adding_stages(const std::filesystem::path& directory);

/// Whether states of a result are others than those of the record it was read from.
bool has_moved(const JamResult& jam, const RecordedReplicate& held);

}  // namespace isojam
