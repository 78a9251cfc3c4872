#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/store.hpp"

namespace isojam {

/// The replicates in a directory whose records do not have all of some measures.
struct Additions {
  std::vector<ReplicateSpec> measured;  ///< replicates whose states are stored, so that measures can be added
  /// names of those among `measured` whose path was not kept: only their nearest states can be measured
  std::vector<std::string> nearest_only;
  /// replicates that failed before the first measure; nothing must be computed for them
  std::vector<ReplicateSpec> failed;
  /// A replicate to whose record nothing can be added, and the reason. "isojam run" can compute the replicate again.
  struct Impossible {
    std::string name, why;
  };
  std::vector<Impossible> impossible;
};

/// Finds, among the records with these names, those that do not have all of the measures. It only reads files. Throws
/// InputError if a record is damaged. Throws FileError if a file cannot be read at the moment.
Additions additions(const std::filesystem::path& directory, const Requests& requests,
                    const std::vector<Measure>& measures, const std::vector<std::string>& names);

/// Adds measures to the records of a store. It reads a record when the work on its replicate begins. Before it replaces
/// the record, it reads the record again, because another process may have changed it.
class Adder {
 public:
  /// `replicates` are all replicates that will be passed to the stages. Each of them is passed once.
  Adder(const Store& store, const std::vector<ReplicateSpec>& replicates);

  /// The stages that add measures. They use this object, which must outlive them. `begin` restores the run from the
  /// record and the path, or from the record and the packing if the path was not kept. `jam` relaxes saddles to minima
  /// if a measure needs minima, but no measure in the record needed them. `measure` takes a measure from the record if
  /// the record has it and no state has changed. Otherwise it computes the measure, and marks a measurement of the
  /// nearest state alone (Measurement::nearest_only).
  Stages stages();

  /// Replaces the record by one with all measures. Returns nullopt, or the reason if this failed; the record is then
  /// unchanged. Throws FileError if the record cannot be read or written at the moment.
  std::optional<std::string> finish(const Outcome& outcome);

 private:
  const Store& store_;
  // records of the replicates that are being processed; nullopt for all others
  std::map<std::string, std::optional<RecordedReplicate>> records_;
};

}  // namespace isojam
