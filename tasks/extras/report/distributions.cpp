#include "tasks/extras/report/distributions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include "engine/arithmetic/elementary.hpp"
#include "tasks/measure/shared_parts.hpp"
#include "tasks/measure/trough_parts.hpp"

namespace isojam {
namespace {

using Numbers = std::vector<double>;

/// The list at a JSON pointer; empty if it is missing or is not a list of numbers.
Numbers bins_at(const Json& json, const std::string& pointer) {
  const Json::json_pointer place(pointer);
  if (!json.contains(place) || !json.at(place).is_array()) return {};
  const auto& list = json.at(place);
  const bool all = std::all_of(list.begin(), list.end(), [](const Json& value) { return value.is_number(); });
  return all ? list.get<Numbers>() : Numbers{};
}

/// Sum of a list over the states. `edges` are the edges of the bins, which are the same in all states.
struct Summed {
  Numbers edges, sums;
  int states = 0;
};

Summed summed(std::span<const Json> states, const std::string& edges, const std::string& values) {
  Summed total;
  for (const Json& state : states) {
    auto ends = bins_at(state, edges), list = bins_at(state, values);
    if (list.empty() || ends.size() != list.size() + 1) continue;
    if (total.states == 0) {
      total.edges = ends;
      total.sums.assign(list.size(), 0);
    }
    total.sums.resize(std::min(total.sums.size(), list.size()));
    for (std::size_t k = 0; k < total.sums.size(); ++k) total.sums[k] += list[k];
    ++total.states;
  }
  return total;
}

/// The curve [[x, y], ...] of a sum over logarithmic bins, between the first and the last bin with values. `y` is
/// called with the sum and the edges of a bin.
Json curve_of(const Summed& total, double unit, const std::function<double(double, double, double)>& y) {
  Json curve = Json::array();
  const auto used = [](double value) { return value > 0; };
  const auto first = std::find_if(total.sums.begin(), total.sums.end(), used) - total.sums.begin();
  const auto last = total.sums.rend() - std::find_if(total.sums.rbegin(), total.sums.rend(), used);
  for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
    const double low = nearest::pow(10, total.edges[k]), high = nearest::pow(10, total.edges[k + 1]);
    curve.push_back({to_digits(unit * std::sqrt(low * high), 5), to_digits(y(total.sums[k], low, high), 5)});
  }
  return curve;
}

Json forces_of(std::span<const Json> states) {
  Json json;
  double all = 0;
  std::array<Summed, 3> classes;
  constexpr std::array names{"face_face", "edge_face", "lower_order"};
  for (std::size_t c = 0; c < names.size(); ++c) {
    const std::string place = std::string("/gaps/") + names[c];
    classes[c] = summed(states, "/gaps/log10_force", place + "/counts");
    all += std::accumulate(classes[c].sums.begin(), classes[c].sums.end(), 0.0);
  }
  if (!(all > 0)) return nullptr;
  auto total = classes[0];
  for (std::size_t c = 1; c < names.size(); ++c) {
    for (std::size_t k = 0; k < std::min(total.sums.size(), classes[c].sums.size()); ++k)
      total.sums[k] += classes[c].sums[k];
  }
  const auto density = [&](double count, double low, double high) { return count / (all * (high - low)); };
  json["curves"]["all"] = curve_of(total, 1, density);
  for (std::size_t c = 0; c < names.size(); ++c) json["curves"][names[c]] = curve_of(classes[c], 1, density);
  json["states"] = total.states;
  return json;
}

using Counts = std::vector<double> (*)(const AngleHistogram& histogram);

/// Sum of the angles of the states, in wider bins than those of the records and without angles below 1e-4 rad.
Summed summed_angles(std::span<const Json> states, Counts counts) {
  constexpr int wide = angle_bins_per_decade / Histogram::per_decade, from = -4;
  constexpr int first = (from - angle_bins_from) * angle_bins_per_decade;
  Summed total;
  total.sums.assign((angle_bins - first + wide - 1) / wide, 0);
  for (std::size_t k = 0; k <= total.sums.size(); ++k)
    total.edges.push_back(from + static_cast<double>(k) / Histogram::per_decade);
  for (const Json& state : states) {
    const Json::json_pointer place{std::string(angle_bins_pointer)};
    if (!state.contains(place)) continue;
    const auto list = counts(read_angle_histogram({state.at(place), "record"}));
    for (int k = first; k < angle_bins; ++k)
      total.sums[static_cast<std::size_t>((k - first) / wide)] += list[static_cast<std::size_t>(k)];
    ++total.states;
  }
  return total;
}

Json angles_of(std::span<const Json> states, Counts counts) {
  const auto total = summed_angles(states, counts);
  const double all = std::accumulate(total.sums.begin(), total.sums.end(), 0.0);
  if (!(all > 0)) return nullptr;
  const auto per_decade = [&](double count, double, double) { return count / all * Histogram::per_decade; };
  return {{"curves", {{"all", curve_of(total, 180 / std::numbers::pi, per_decade)}}}, {"states", total.states}};
}

Json pairs_of(std::span<const Json> states) {
  const auto total = summed(states, "/gaps/r", "/gaps/g");
  if (total.sums.empty()) return nullptr;
  Json curve = Json::array();
  for (std::size_t k = 0; k < total.sums.size(); ++k)
    curve.push_back(
        {to_digits((total.edges[k] + total.edges[k + 1]) / 2, 5), to_digits(total.sums[k] / total.states, 5)});
  return {{"curves", {{"all", std::move(curve)}}}, {"states", total.states}};
}

/// Density of the exponents x of the contacts (analysis/exponents.hpp), in bins of 0.1 that are centred on the classes.
Json exponents_of(std::span<const Json> states) {
  constexpr int per_unit = 10, from = -8 * per_unit, bins = 11 * per_unit;
  Numbers counts(bins, 0);
  long contacts = 0;
  int measured = 0;
  for (const Json& state : states) {
    const Json::json_pointer place("/exponents/x");
    if (!state.contains(place) || state.at(place).empty()) continue;
    ++measured;
    for (const Json& x : state.at(place)) {
      ++contacts;
      if (!x.is_number()) continue;
      const auto bin = std::lround(x.get<double>() * per_unit) - from;
      if (bin >= 0 && bin < bins) ++counts[static_cast<std::size_t>(bin)];
    }
  }
  if (measured == 0) return nullptr;
  Json curve = Json::array();
  for (int k = 0; k < bins; ++k)
    curve.push_back({to_digits(static_cast<double>(k + from) / per_unit, 3),
                     to_digits(counts[static_cast<std::size_t>(k)] / static_cast<double>(contacts) * per_unit, 5)});
  return {{"curves", {{"all", std::move(curve)}}}, {"states", measured}};
}

}  // namespace

Json pooled_distributions(std::span<const Json> states) {
  return {{"forces", forces_of(states)},
          {"pairs", pairs_of(states)},
          {"exponents", exponents_of(states)},
          {"face_face", angles_of(states, [](const AngleHistogram& all) { return all.face_face; })},
          {"edge_face", angles_of(states, [](const AngleHistogram& all) { return all.edge_face_of_others(0); })}};
}

}  // namespace isojam
