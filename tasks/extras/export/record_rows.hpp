#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/io/rows.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/records/recorded.hpp"

namespace isojam {

/// The object that one row of a table describes.
enum class RowOf : std::uint8_t {
  replicate,  ///< a replicate, with the quantities of the replicate and of its state nearest jamming
  state       ///< a state of a decompression, with its quantities
};

/// Records as tables with one row per replicate or state, and one column per measured quantity. The columns are:
/// replicate, solid, particles, swept parameters, number (of the replicate at its sweep point), status, flags and
/// reasons as texts with "; " between them, excluded (from means); phi, delta_phi and the other values of a state; the
/// quantities with their names in tables; evaluations and cpu_seconds of a replicate. Numbers are copied from the
/// records. A missing value stays null, and `reasons` contains the reason.
class RecordRows {
 public:
  /// The columns depend on the manifest, or on the specification of the record `first` if there is no manifest.
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
  std::vector<std::size_t> quantities_;  ///< indices in all_quantities() of the quantities that are columns
};

}  // namespace isojam
