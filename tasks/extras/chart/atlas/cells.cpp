#include "tasks/extras/chart/atlas/cells.hpp"

#include <fmt/format.h>

namespace isojam {

AtlasRow judged(AtlasRow row, std::optional<double> error, double tolerance, const std::string& what) {
  row.figure = error ? fmt::format("{} {:.0e}", what, *error) : what + " not defined";
  const bool holds = error && *error <= tolerance;
  row.verdict = holds ? AtlasVerdict::holds : AtlasVerdict::fails;
  row.reason = fmt::format("{} {:.0e}", holds ? "within" : "not within", tolerance);
  return row;
}

AtlasRow refused(AtlasRow row, const std::string& why) {
  row.verdict = AtlasVerdict::refuses;
  row.reason = why;
  return row;
}

std::string decade_name(double x) { return x == 0 ? "exactly" : fmt::format("{:.0e}", x); }

}  // namespace isojam
