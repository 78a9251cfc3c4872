#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/replicate/replicate.hpp"
#include "tasks/store/store.hpp"

namespace isojam {

/// The measures that the records of a directory lack, compared with a manifest.
struct Additions {
  std::vector<ReplicateSpec> measured;  ///< replicates whose stored paths can be measured
  std::vector<ReplicateSpec> failed;    ///< replicates that failed before their states were measured
  /// A replicate whose states are not stored, and the reason. Only a run makes it again.
  struct Impossible {
    std::string name, why;
  };
  std::vector<Impossible> impossible;
};

/// Reads only. `names`: of records. Throws InputError for a record that is damaged, of another sweep or not of the
/// plan, FileError for what cannot be read now.
Additions additions(const std::filesystem::path& directory, const Plan& plan, const std::vector<std::string>& names);

/// Adds measures to the records of a store. A record is read and checked when its replicate begins. Before it is
/// replaced it is read once more, since another process may have changed it.
class Adder {
 public:
  /// `replicates`: those that the stages will be given, each once.
  Adder(const Store& store, const std::vector<ReplicateSpec>& replicates);

  /// The run is restored from record and path. States are followed to minima if a measure needs that for the first
  /// time. Earlier measures are taken from the record unless a state has moved. The stages use this object.
  Stages stages();

  /// Replaces the record by one with all measures; returns the reason if it cannot. The record then stays as it is.
  /// Throws FileError if the record cannot be read or written now.
  std::optional<std::string> finish(const Outcome& outcome);

 private:
  const Store& store_;
  std::map<std::string, std::optional<RecordedReplicate>> records_;  // those in flight have a value
};

}  // namespace isojam
