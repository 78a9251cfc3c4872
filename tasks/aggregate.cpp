#include "tasks/aggregate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

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

/// Linear in ln Δφ between the states on either side of `distance`, column by column; nothing where they do not enclose
/// it or one lacks the value.
Values interpolated(std::span<const StateValues> states, double distance) {
  const auto above =
      std::find_if(states.begin(), states.end(), [=](const StateValues& s) { return s.delta_phi >= distance; });
  if (above == states.begin() || above == states.end()) return {};
  const StateValues &low = above[-1], &high = *above;
  const double weight = std::log(distance / low.delta_phi) / std::log(high.delta_phi / low.delta_phi);
  Values values;
  for (std::size_t i = 0; i < all_columns.size(); ++i) {
    if (low.values[i] && high.values[i]) values[i] = (1 - weight) * *low.values[i] + weight * *high.values[i];
  }
  return values;
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

/// The values of a sweep point's replicates, column by column.
class Samples {
 public:
  void add(const Values& values, bool flagged) {
    for (std::size_t i = 0; i < all_columns.size(); ++i) {
      if (!values[i]) continue;
      all_[i].push_back(*values[i]);
      if (!flagged) unflagged_[i].push_back(*values[i]);
    }
  }
  bool empty() const {
    return std::all_of(all_.begin(), all_.end(), [](const auto& values) { return values.empty(); });
  }
  /// With the flagged replicates, and without.
  std::pair<Estimates, Estimates> estimates(const std::string& point) const {
    std::pair<Estimates, Estimates> result;
    for (std::size_t i = 0; i < all_columns.size(); ++i) {
      const auto seed = hash_of(point + std::string(all_columns[i].name));
      result.first[i] = estimate(all_[i], seed);
      result.second[i] = estimate(unflagged_[i], seed);
    }
    return result;
  }

 private:
  std::array<std::vector<double>, all_columns.size()> all_, unflagged_;
};

Row make_row(const Point& point) {
  const auto& first = *point.begin()->second;
  Row row;
  row.solid = first.solid;
  row.particles = first.particles;
  row.parameters = first.parameters;
  row.replicates = static_cast<int>(point.size());
  Samples nearest;
  for (const auto& [key, record] : point) {
    row.failed += record->failed;
    row.flagged += record->flagged;
    nearest.add(record->values, record->flagged);
    if (record->residual) row.residual = std::max(row.residual.value_or(0), *record->residual);
  }
  const auto text = point_text(first.solid, first.particles, first.parameters);
  std::tie(row.estimates, row.unflagged) = nearest.estimates(text);
  for (const double distance : series_distances) {
    Samples there;
    for (const auto& [key, record] : point) there.add(interpolated(record->states, distance), record->flagged);
    if (there.empty()) continue;
    row.series.push_back({distance, {}, {}});
    std::tie(row.series.back().estimates, row.series.back().unflagged) = there.estimates(text);
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
