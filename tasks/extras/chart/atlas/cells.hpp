#pragma once

#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "tasks/extras/chart/atlas/atlas.hpp"

// Shared by the parts of the atlas.

namespace isojam {

/// Collects rows in the order in which they are added. After a stop request no row is added, because its measurement
/// may be incomplete.
class AtlasRows {
 public:
  explicit AtlasRows(std::stop_token stop) : stop_(std::move(stop)) {}

  const std::stop_token& stop() const { return stop_; }
  bool over() const { return stop_.stop_requested(); }
  void add(AtlasRow row) {
    if (!over()) rows_.push_back(std::move(row));
  }
  std::vector<AtlasRow> taken() { return std::move(rows_); }

 private:
  std::stop_token stop_;
  std::vector<AtlasRow> rows_;
};

/// Sets the verdict of a row: holds if error ≤ tolerance; fails if it is larger or if there is no value. `what` is the
/// name of the error.
AtlasRow judged(AtlasRow row, std::optional<double> error, double tolerance, const std::string& what);

AtlasRow refused(AtlasRow row, const std::string& why);

/// "1e-10"; "exactly" for 0.
std::string decade_name(double x);

}  // namespace isojam
