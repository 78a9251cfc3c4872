#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tasks/io/rows.hpp"
#include "tasks/manifest/manifest.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/recorded.hpp"

namespace isojam {

/// Kind of object that a row describes.
enum class RowOf : std::uint8_t {
  replicate,  ///< a replicate, with the quantities of the replicate and of its nearest state
  state       ///< a state of a decompression, with its quantities
};

/// Records as a table with one row per replicate or state. The columns are, in this order:
/// - replicate (its name), solid, particles, the swept parameters, and number (of the replicate at its sweep point)
/// - only for replicates: status, failed_in and failure
/// - flags, separated by "; ", and excluded (true if the replicate is excluded from means)
/// - state (its index), only for states nearest (true for the state nearest jamming), and the fields of every state
/// - one column per measured quantity, with its name in tables
/// - the other numbers and texts of the measures; only for replicates also those of the record. Their names are the
///   keys that lead to the value, separated by dots.
/// - reasons for missing quantities, separated by "; "
///
/// Numbers are copied from the records. A missing value is null.
class RecordRows {
 public:
  /// The columns depend on the manifest. Without a manifest, they depend on the specification of the record `first`.
  RecordRows(RowOf of, RowFormat format, const std::optional<Manifest>& manifest, const RecordedReplicate& first);

  /// The first line of the table.
  std::string head() const;
  /// Names of the columns with texts. The others have numbers or truth values.
  const Columns& texts() const { return texts_; }
  /// The lines of a replicate. If it failed, it has one line in the table of replicates, and none in the table of
  /// states.
  std::string lines(const RecordedReplicate& held) const;

 private:
  /// Sources of the values of a row; `state` is null for a failed replicate.
  struct Source {
    const RecordedReplicate& held;
    const Json* state;
    std::size_t index;
  };
  using Value = std::function<Json(const Source&)>;

  void add(std::string name, Value value);
  void add_text(const std::string& name, Value value);
  void add_head(const std::vector<std::string>& parameters);
  void add_quantities(const std::vector<Measure>& measures, std::size_t kinds);
  /// Adds the fields that are neither quantities nor columns of the head.
  void add_fields(const Fields& fields, Quantity::Of of, std::size_t kinds);
  std::string reasons(const Source& source) const;
  std::string line(const Source& source) const;

  RowOf of_;
  RowFormat format_;
  std::vector<Flag> exclude_;
  Columns columns_, texts_;
  std::vector<Value> values_;
  std::vector<std::size_t> quantities_;  ///< indices in all_quantities() of the quantities that are columns
};

}  // namespace isojam
