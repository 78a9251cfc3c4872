#pragma once

#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/replicate/replicate.hpp"
#include "tasks/store/store.hpp"

namespace isojam {

/// What there is to add to the records of a directory for them to have all measures of a manifest.
struct Additions {
  std::vector<ReplicateSpec> measured;  ///< from their paths
  std::vector<ReplicateSpec> failed;    ///< before anything was measured: their records say what else they have not
  /// Those of which nothing is kept that could be measured, and why: only a run makes them again.
  struct Impossible {
    std::string name, why;
  };
  std::vector<Impossible> impossible;
};

/// Reads only. `names`: of records. Throws InputError for a record that is damaged, of another sweep or not of the
/// plan, FileError for what cannot be read now.
Additions additions(const std::filesystem::path& directory, const Plan& plan, const std::vector<std::string>& names);

/// The stages by which a replicate gets what its record lacks: its run is read back from record and path, states are
/// followed to minima if that is needed for the first time, and what was measured before is taken from the record
/// unless that moved a state.
Stages adding_stages(const std::filesystem::path& directory);

/// Whether states of a result are others than those of the record it was read from.
bool has_moved(const JamResult& jam, const RecordedReplicate& held);

}  // namespace isojam
