#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "tasks/extras/chart/atlas/atlas.hpp"

// Functions and classes that several parts of the atlas use.

namespace isojam {

/// Collects rows in the order in which they are added. After a stop request it adds no row, because the measurement of
/// the row may be incomplete.
class AtlasRows {
 public:
  explicit AtlasRows(std::stop_token stop) : stop_(std::move(stop)) {}

  const std::stop_token& stop() const { return stop_; }
  bool over() const { return stop_.stop_requested(); }
  void add(AtlasRow row) {
    if (!over()) rows_.push_back(std::move(row));
  }
  /// All collected rows. Call it only once.
  std::vector<AtlasRow> taken() { return std::move(rows_); }

 private:
  std::stop_token stop_;
  std::vector<AtlasRow> rows_;
};

/// Sets the verdict of a row: `holds` if error ≤ tolerance, and `fails` if the error is larger or missing. `what` is
/// the name of the error.
AtlasRow judged(AtlasRow row, std::optional<double> error, double tolerance, const std::string& what);

/// Sets the verdict `refuses` of a row, with the reason.
AtlasRow refused(AtlasRow row, const std::string& why);

/// Text such as "1e-10"; "exactly" for 0.
std::string decade_name(double x);

}  // namespace isojam
