#include "tasks/aggregate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "tasks/input_error.hpp"
#include "tasks/plan.hpp"

namespace isojam {
namespace {

using PointKey = std::tuple<SolidKind, int, Json>;
using ReplicateKey = std::tuple<std::string, int>;  // manifest digest, replicate
using Point = std::map<ReplicateKey, const RecordSummary*>;

std::string describe(const RecordSummary& record) {
  return fmt::format("{} replicate {} of manifest {}", point_text(record.solid, record.particles, record.parameters),
                     record.replicate, record.manifest_digest);
}

/// First path at which two JSON values differ.
std::string difference(const Json& a, const Json& b) {
  const auto patch = Json::diff(a, b);
  return patch.empty() ? "" : patch.front().at("path").get<std::string>();
}

void add(Point& point, const RecordSummary& record) {
  if (!point.empty() && point.begin()->second->settings != record.settings) {
    const auto& other = *point.begin()->second;
    throw InputError({describe(record), difference(other.settings, record.settings),
                      "differs from the setting of " + describe(other), "one table of records with the same settings",
                      ""});
  }
  const auto [place, added] = point.try_emplace({record.manifest_digest, record.replicate}, &record);
  if (!added && place->second->result != record.result) {
    throw InputError({describe(record), difference(place->second->result, record.result),
                      "is recorded twice with different results", "", ""});
  }
}

Row make_row(const Point& point) {
  const auto& first = *point.begin()->second;
  Row row{first.solid, first.particles, first.parameters, static_cast<int>(point.size()), 0, 0, {}, {}, {}};
  std::array<std::vector<double>, columns.size()> values, unflagged;
  for (const auto& [key, record] : point) {
    row.failed += record->failed;
    row.flagged += record->flagged;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!record->values[i]) continue;
      values[i].push_back(*record->values[i]);
      if (!record->flagged) unflagged[i].push_back(*record->values[i]);
    }
    if (record->residual) row.residual = std::max(row.residual.value_or(0), *record->residual);
  }
  const auto text = point_text(first.solid, first.particles, first.parameters);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto seed = hash_of(text + std::string(columns[i].name));
    row.estimates[i] = estimate(std::move(values[i]), seed);
    row.unflagged[i] = estimate(std::move(unflagged[i]), seed);
  }
  return row;
}

}  // namespace

Table aggregate(std::span<const RecordSummary> records) {
  std::map<PointKey, Point> points;
  for (const auto& record : records) add(points[{record.solid, record.particles, record.parameters}], record);
  Table table;
  for (const auto& [key, point] : points) table.rows.push_back(make_row(point));
  return table;
}

}  // namespace isojam
