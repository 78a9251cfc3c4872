#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/json/rows.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/store/recorded.hpp"

namespace isojam {

/// What a row of records stands for.
enum class RowOf : std::uint8_t {
  replicate,  ///< with what was measured of it as a whole and of its state nearest jamming
  state       ///< every state of the expansions, with what was measured of it
};

/// Records as tidy tables: a row for each replicate or state, a column for each quantity that was measured. Columns:
/// replicate, solid, particles, swept parameters, number (of the replicate at its sweep point), status, flags and
/// reasons as texts with "; " between, excluded (from means); phi, delta_phi and the other figures of a state; the
/// quantities, under their names in tables; evaluations and cpu_seconds of a replicate. Numbers as they stand in the
/// records, null where the record has null: `reasons` says why of each.
class RecordRows {
 public:
  /// Columns are those of the manifest, or where there is none, of this record's specification.
  RecordRows(RowOf of, RowFormat format, const std::optional<Manifest>& manifest, const RecordedReplicate& first);

  std::string head() const;
  /// A failed replicate has one row among replicates, and none among states.
  std::string lines(const std::filesystem::path& directory, const RecordedReplicate& held) const;

 private:
  /// Where values of a row come from; `state` is null of a failed replicate.
  struct Source {
    const RecordedReplicate& held;
    const Json* state;
    std::size_t index;
  };
  using Value = std::function<Json(const Source&)>;

  void add(std::string name, Value value);
  void add_head(const std::vector<std::string>& parameters);
  void add_state();
  void add_quantities(const std::vector<Measure>& measures, std::size_t kinds);
  std::string reasons(const Source& source) const;
  std::string line(const Source& source) const;

  RowOf of_;
  RowFormat format_;
  std::vector<Flag> exclude_;
  Columns columns_;
  std::vector<Value> values_;
  std::vector<std::size_t> quantities_;  ///< by their places in all_quantities()
};

}  // namespace isojam
