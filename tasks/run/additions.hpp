#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tasks/manifest/plan.hpp"
#include "tasks/records/replicate.hpp"
#include "tasks/records/store.hpp"

namespace isojam {

/// The records of a directory that lack measures of a manifest.
struct Additions {
  std::vector<ReplicateSpec> measured;  ///< replicates whose stored states can be measured
  std::vector<ReplicateSpec> failed;    ///< replicates that failed before their states were measured
  /// A replicate whose states are not stored, and the reason. Only isojam run can compute its measures.
  struct Impossible {
    std::string name, why;
  };
  std::vector<Impossible> impossible;
};

/// Finds the records that lack measures, among the records with these names. It only reads files. Throws InputError if
/// a record is damaged, belongs to another sweep, or is not in the plan. Throws FileError if a file cannot be read at
/// the moment.
Additions additions(const std::filesystem::path& directory, const Plan& plan, const std::vector<std::string>& names);

/// Adds measures to the records of a store. A record is read and checked when the work on its replicate begins. It is
/// read again before it is replaced, because another process may have changed it.
class Adder {
 public:
  /// `replicates` are all replicates that will be passed to the stages, each of them once.
  Adder(const Store& store, const std::vector<ReplicateSpec>& replicates);

  /// The stages that add measures. The run is restored from the record and the path. If a measure needs minima and no
  /// earlier measure did, saddles are relaxed to minima. Earlier measures are taken from the record if no state has
  /// changed. The stages use this object, which must outlive them.
  Stages stages();

  /// Replaces the record by one with all measures. If this is impossible, returns the reason and does not change the
  /// record. Throws FileError if the record cannot be read or written at the moment.
  std::optional<std::string> finish(const Outcome& outcome);

 private:
  const Store& store_;
  std::map<std::string, std::optional<RecordedReplicate>> records_;  // those in flight have a value
};

}  // namespace isojam
