#include "tasks/tables/aggregate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/arithmetic/elementary.hpp"
#include "tasks/io/input_error.hpp"
#include "tasks/manifest/base.hpp"
#include "tasks/manifest/plan.hpp"
#include "tasks/measure/quantity.hpp"
#include "tasks/records/summary.hpp"
#include "tasks/tables/stopping.hpp"

namespace isojam {
namespace {

std::string describe(const RecordSummary& record) {
  return fmt::format("{} replicate {} of seed {}", point_text(record.solid, record.particles, record.parameters),
                     record.replicate, record.seed);
}

/// Two neighbouring states, and the weight of the second one in a linear interpolation in ln Δφ.
struct Neighbours {
  const StateValues &low, &high;
  double weight;
};

/// The states around `distance`; nullopt if `distance` is outside of all states.
std::optional<Neighbours> neighbours(std::span<const StateValues> states, double distance) {
  const auto above =
      std::find_if(states.begin(), states.end(), [=](const StateValues& s) { return s.delta_phi >= distance; });
  if (above == states.begin() || above == states.end()) return std::nullopt;
  const StateValues &low = above[-1], &high = *above;
  return Neighbours{low, high, nearest::log(distance / low.delta_phi) / nearest::log(high.delta_phi / low.delta_phi)};
}

/// All quantities between two states. A quantity is empty if one of the two states lacks the value.
Values interpolated(const Neighbours& at) {
  Values values = no_values();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (at.low.values[i] && at.high.values[i])
      values[i] = (1 - at.weight) * *at.low.values[i] + at.weight * *at.high.values[i];
  }
  return values;
}

/// The histogram of angles between two states; nullopt if one of the two states lacks it.
std::optional<AngleHistogram> interpolated_angles(const Neighbours& at) {
  if (!at.low.angles || !at.high.angles) return std::nullopt;
  AngleHistogram histogram = *at.low.angles;
  histogram.add(*at.low.angles, -at.weight);
  histogram.add(*at.high.angles, at.weight);
  return histogram;
}

/// JSON pointer of the first difference between two values; empty if they are equal.
std::string difference(const Json& a, const Json& b) {
  const auto patch = Json::diff(a, b);
  return patch.empty() ? "" : patch.front().at("path").get<std::string>();
}

Estimate estimate_of(const Quantity& quantity, const std::vector<double>& values, std::uint64_t key) {
  return quantity.proportion ? proportion_estimate(values) : estimate(values, key);
}

constexpr std::size_t places = 1 + series_distances.size();

}  // namespace

std::optional<double> Aggregation::Kept::at(Cell cell) const {
  const auto found = std::lower_bound(cells->begin(), cells->end(), cell);
  if (found == cells->end() || *found != cell) return std::nullopt;
  return values[static_cast<std::size_t>(found - cells->begin())];
}

Aggregation::Kept Aggregation::kept(const RecordSummary& record) {
  Kept kept{hash_of(record.result_digest),
            record.failed,
            record.reached_limit,
            record.flagged,
            has_any(record, exclude_),
            record.residual,
            nullptr,
            {}};
  Cells cells;
  const auto keep = [&](const Values& values, std::size_t place) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!values[i]) continue;
      cells.push_back(static_cast<Cell>(place * values.size() + i));
      kept.values.push_back(*values[i]);
    }
  };
  keep(record.values, 0);
  for (std::size_t k = 0; k < series_distances.size(); ++k) {
    const auto at = neighbours(record.states, series_distances[k]);
    if (at) keep(interpolated(*at), k + 1);
  }
  kept.values.shrink_to_fit();
  kept.cells = &*layouts_.insert(std::move(cells)).first;
  return kept;
}

void Aggregation::add_angles(const RecordSummary& record, Point& point) {
  const auto add = [&](const std::optional<AngleHistogram>& angles, std::size_t place) {
    if (angles) point.angles[place].add(record.study, record.replicate, *angles);
  };
  add(record.angles, 0);
  for (std::size_t k = 0; k < series_distances.size(); ++k) {
    const auto at = neighbours(record.states, series_distances[k]);
    if (at) add(interpolated_angles(*at), k + 1);
  }
}

Values Aggregation::own_values(const Kept& kept) {
  Values values = no_values();
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = kept.at(static_cast<Cell>(i));
  return values;
}

void Aggregation::add(const RecordSummary& record) {
  auto& point = points_[{record.solid, record.particles, record.parameters}];
  builds_.insert(record.build);
  for (const auto& before : record.before) builds_.insert(before.added_by);
  if (point.replicates.empty()) {
    point.settings = record.settings;
    point.first = describe(record);
  } else if (point.settings != record.settings) {
    throw InputError({describe(record), difference(point.settings, record.settings),
                      "differs from the setting of " + point.first, "", "",
                      "aggregate only records with the same settings"});
  }
  const auto [place, added] = point.replicates.try_emplace({record.study, record.replicate}, kept(record));
  for (const auto flag : record.flags) {
    if (added && std::find(exclude_.begin(), exclude_.end(), flag) != exclude_.end()) ++excluded_[flag];
  }
  if (added && place->second.counts()) add_angles(record, point);
  if (added) {
    for (const auto measure : record.nearest_only) ++nearest_only_[measure];
  }
  if (!added && place->second.result != hash_of(record.result_digest)) {
    throw InputError({describe(record), "/result_digest", "two records of this replicate have different results", "",
                      "", "remove one of them"});
  }
}

std::optional<GoalOutcome> Aggregation::goal_outcome(const Point& point, const std::optional<Replicates>& rule) {
  if (!rule || !rule->goal) return std::nullopt;
  const auto quantity = quantity_index(rule->goal->quantity);
  // Values of the replicates 0, 1, … of one manifest, up to the first missing replicate.
  std::vector<std::optional<double>> values;
  for (const auto& [key, replicate] : point.replicates) {
    if (key.first != point.replicates.begin()->first.first || key.second != static_cast<int>(values.size())) break;
    values.push_back(replicate.excluded ? std::nullopt : replicate.at(static_cast<Cell>(*quantity)));
  }
  const auto advance = advance_of(*rule, values);
  return GoalOutcome{*rule->goal, advance.finished ? std::optional(advance.wanted) : std::nullopt, advance.met,
                     advance.half_width, advance.first};
}

std::optional<PooledTrough> Aggregation::trough(const PointKey& key, const Point& point, std::size_t place) {
  const auto& [solid, particles, parameters] = key;
  const auto angles = point.angles.find(place);
  if (angles == point.angles.end()) return std::nullopt;
  return angles->second.trough(particles, point_text(solid, particles, parameters));
}

void Aggregation::put_estimates(const Point& point, const std::string& text, std::size_t place, Estimates& estimates,
                                Estimates& all) {
  // The values of one quantity at a time are copied, because all values together would need as much memory again.
  std::vector<double> every, included;
  for (std::size_t i = 0; i < all_quantities().size(); ++i) {
    const auto cell = static_cast<Cell>(place * all_quantities().size() + i);
    every.clear();
    included.clear();
    for (const auto& [name, replicate] : point.replicates) {
      const auto value = replicate.at(cell);
      if (value) every.push_back(*value);
      if (value && !replicate.excluded) included.push_back(*value);
    }
    const auto& quantity = all_quantities()[i];
    const auto seed = hash_of(text + std::string(quantity.name));
    estimates[i] = estimate_of(quantity, included, seed);
    all[i] = estimate_of(quantity, every, seed);
  }
}

Row Aggregation::row(const PointKey& key, const Point& point, const std::optional<Replicates>& rule) {
  Row row;
  std::tie(row.solid, row.particles, row.parameters) = key;
  row.replicates = static_cast<int>(point.replicates.size());
  std::array<bool, places> present{};
  const Cells* seen = nullptr;
  for (const auto& [name, replicate] : point.replicates) {
    row.failed += replicate.failed;
    row.reached_limit += replicate.reached_limit;
    row.flagged += replicate.flagged;
    row.excluded += replicate.excluded;
    if (replicate.residual) row.residual = std::max(row.residual.value_or(0), *replicate.residual);
    if (std::exchange(seen, replicate.cells) == replicate.cells) continue;
    for (const auto cell : *replicate.cells) present[cell / all_quantities().size()] = true;
  }
  const auto text = point_text(row.solid, row.particles, row.parameters);
  put_estimates(point, text, 0, row.estimates, row.all);
  row.trough = trough(key, point, 0);
  for (std::size_t k = 0; k < series_distances.size(); ++k) {
    if (!present[k + 1]) continue;
    auto& at = row.series.emplace_back(SeriesPoint{series_distances[k]});
    put_estimates(point, text, k + 1, at.estimates, at.all);
    at.trough = trough(key, point, k + 1);
  }
  row.goal = goal_outcome(point, rule);
  // The stopping rule chose the number of replicates, unless there is only one number to choose from.
  if (row.goal && rule->min < rule->max && row.goal->first.size() > 1)
    use_stein(row.estimates[*quantity_index(row.goal->goal.quantity)], row.goal->first);
  return row;
}

std::optional<Differences> Aggregation::differences(const PointKey& key, const Point& point) const {
  const auto& [solid, particles, parameters] = key;
  auto others = parameters;
  for (const auto& item : base_.items()) {
    // If records of several manifests are combined, this row may be of a sweep without this parameter.
    if (!parameters.contains(item.key())) return std::nullopt;
    others[item.key()] = item.value();
  }
  if (others == parameters) return std::nullopt;
  Differences differences;
  const auto base = points_.find({solid, particles, others});
  if (base == points_.end()) return differences;
  std::vector<std::vector<double>> samples(all_quantities().size());
  for (const auto& [name, replicate] : point.replicates) {
    const auto other = base->second.replicates.find(name);
    if (other == base->second.replicates.end() || !replicate.counts() || !other->second.counts()) continue;
    ++differences.pairs;
    const auto values = own_values(replicate), base_values = own_values(other->second);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (values[i] && base_values[i]) samples[i].push_back(*values[i] - *base_values[i]);
    }
  }
  const auto text = fmt::format("{} less {}", point_text(solid, particles, parameters), base_text(base_));
  for (std::size_t i = 0; i < samples.size(); ++i)
    differences.estimates[i] = estimate(samples[i], hash_of(text + std::string(all_quantities()[i].name)));
  return differences;
}

Table Aggregation::table(const std::optional<Replicates>& rule) const {
  Table table{{}, exclude_, excluded_, nearest_only_, base_, builds_};
  for (const auto& [key, point] : points_) {
    table.rows.push_back(row(key, point, rule));
    table.rows.back().differences = differences(key, point);
  }
  return table;
}

Table aggregate(std::span<const RecordSummary> records, const std::optional<Replicates>& rule,
                std::vector<Flag> exclude, Json base) {
  Aggregation aggregation(std::move(exclude), std::move(base));
  for (const auto& record : records) aggregation.add(record);
  return aggregation.table(rule);
}

}  // namespace isojam
