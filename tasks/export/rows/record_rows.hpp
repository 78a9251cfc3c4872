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

/// The entity that one row describes.
enum class RowOf : std::uint8_t {
  replicate,  ///< a replicate, with the measurements of the replicate and of its state nearest jamming
  state       ///< a state of an expansion, with its measurements
};

/// Records as tidy tables: one row per replicate or state, one column per measured quantity. Columns: replicate, solid,
/// particles, swept parameters, number (of the replicate at its sweep point), status, flags and reasons as texts with
/// "; " between, excluded (from means); phi, delta_phi and the other figures of a state; the quantities, under their
/// names in tables; evaluations and cpu_seconds of a replicate. Numbers are copied from the records; null stays null,
/// and `reasons` gives the reason for each.
class RecordRows {
 public:
  /// Columns follow the manifest or, without one, this record's specification.
  RecordRows(RowOf of, RowFormat format, const std::optional<Manifest>& manifest, const RecordedReplicate& first);

  std::string head() const;
  /// A failed replicate has one row in the table of replicates, and none in the table of states.
  std::string lines(const std::filesystem::path& directory, const RecordedReplicate& held) const;

 private:
  /// Sources of the values of a row; `state` is null for a failed replicate.
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
  std::vector<std::size_t> quantities_;  ///< as indices in all_quantities()
};

}  // namespace isojam
